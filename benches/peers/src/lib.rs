//! Parts that both programs share: the interface of an engine, Rapier, and CPU time.
#![allow(clippy::disallowed_methods, reason = "a bench measures time; its sums need not be the same everywhere")]

pub mod clock;
pub mod engine;
pub mod rapier;
