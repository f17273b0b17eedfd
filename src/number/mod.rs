//! The ladder of numbers that a tape is evaluated in.

mod func;

pub use func::Func;
