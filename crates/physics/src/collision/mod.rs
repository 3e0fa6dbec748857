//! Collision detection: swept bounds, box against box and box against floor, contact manifolds.

pub mod box_box;
pub mod broad_phase;
pub mod contacts;
pub mod friction_levers;
pub mod manifold;
pub mod polygon;
