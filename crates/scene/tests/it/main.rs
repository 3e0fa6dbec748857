//! Tests of the crate from outside, in one program: each program costs its link.

mod bad_scenes;
mod bad_values;
mod cards;
mod common;
mod named;
mod notation;
mod overlap;
mod reading;
mod round_trip;
mod settle;
mod statics;
mod towers;
