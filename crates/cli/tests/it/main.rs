//! Tests of the crate from outside, in one program: each program costs its link.

#[path = "../common/mod.rs"]
mod common;

mod analyse;
mod bad_input;
mod calibrate;
mod dissertation;
mod encodings;
mod forces;
mod inputs;
mod interruption;
mod large;
mod render;
mod replay;
mod run;
mod scenes;
mod score;
mod tournament;
mod trace;
mod validate;
