//! Collision detection: swept bounds, box against box and box against floor, contact manifolds.

pub mod box_box;
pub mod box_floor;
pub mod broad_phase;
pub mod cached_pair;
pub mod contacts;
pub mod cuboid;
pub mod edge_contact;
pub mod face_contact;
pub mod friction_arms;
pub mod friction_levers;
pub mod lookahead;
pub mod manifold;
pub mod nearest;
pub mod pair_status;
pub mod passivity;
pub mod polygon;
pub mod relative_twist;
pub mod separating_axis;
pub mod stable_spring;
