//! Tests of the crate from outside, in one program: each program costs its link.

mod breakaway;
mod closed_forms;
mod clusters;
mod common;
mod damage;
mod edges;
mod energy;
mod fast;
mod hand;
mod lattice;
mod long;
mod overload;
mod random;
mod release;
mod restore;
mod sliding_and_spinning;
mod start;
mod state;
mod tower;
