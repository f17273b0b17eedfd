//! Kenzan (検算): a doctest for the equations of lecture notes.
//!
//! The notes are the program: each displayed equation is read from its own LaTeX, understood with what an annotation
//! says of its symbols, lowered to a graph of scalar operations, evaluated at random states in numbers of rising
//! strength, and judged.
//!
//! The modules are floors; each uses only floors below it.
//!
//! | floor | modules |
//! |---|---|
//! | 6 | `cli`, `watch`, `lsp` |
//! | 5 | `verify`, `incremental`, `init`, `symbols`, `files`, `config`, `explain`, `speed`, `stability` |
//! | 4 | `report`, `diagnose`, `infer` |
//! | 3 | `semantics`, `check`, `scene` |
//! | 2 | `expr`, `integrator` |
//! | 1 | `document`, `latex`, `number`, `breakdown`, `trace` |

pub mod breakdown;
pub mod check;
pub mod cli;
pub mod config;
pub mod diagnose;
pub mod document;
pub mod explain;
pub mod expr;
pub mod files;
pub mod incremental;
pub mod infer;
pub mod init;
pub mod integrator;
pub mod latex;
pub mod lsp;
pub mod number;
pub mod report;
pub mod scene;
pub mod semantics;
pub mod speed;
pub mod stability;
pub mod symbols;
#[cfg(test)]
mod testing;
pub mod trace;
pub mod verify;
pub mod watch;
