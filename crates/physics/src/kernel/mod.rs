//! Inner loop over packed groups of contacts and bodies, and the packing between it and the state.
//!
//! A lane holds a contact or a body of its own, never a part of a sum, and forces are added to the
//! bodies in the order of the lanes, group by group: the register width does not change the result.
//! The loop holds no positions, only displacements since the last sync, for a gap formed from f32
//! positions would be wrong by 30 nm. Velocities are displacements per substep, which saves
//! multiplications by the substep.

pub mod affine_motion;
pub mod any_kernel;
pub mod body_model;
pub mod contact_law;
pub mod edge_rotation;
pub mod inner_loop;
pub mod lattice;
pub mod layout;
pub mod packing;
pub mod rigid;
pub mod spring;
pub mod sync_set;
pub mod tangential_refine;
pub mod uniform_motion;
pub mod vector;
