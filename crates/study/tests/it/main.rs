//! Tests of the crate from outside, in one program: each program costs its link.

mod falls;
mod forces;
mod play;
