//! The bodies that the notes talk about, and their motions.

pub mod top;
