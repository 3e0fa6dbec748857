//! Tests of the crate from outside, in one program: each program costs its link.

mod blocks;
mod collision;
mod common;
mod counters;
mod detection;
mod disabling;
mod flat;
mod future_work;
mod ini;
mod integrators;
mod stability;
mod states;
mod static_towers;
