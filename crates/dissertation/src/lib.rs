//! The simulators of "A Real-Time Physics Simulator for Jenga" (Matthew South, University of Sheffield, 2003), written anew from its
//! equations: [`jenga3d`], the 3-D spring simulator of chapters 4 and 5, and [`flat`], its prototypes in the plane and the other methods of
//! chapter 2.
//!
//! Numbers such as Eq. 4.10 are those of the dissertation. Where it is silent or wrong, what is done instead is said at that line and listed
//! in `docs/dissertation.md`. Nothing here uses the engine of `teeter-physics`.

pub mod flat;
pub mod jenga3d;
