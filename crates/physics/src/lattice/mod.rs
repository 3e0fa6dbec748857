//! Lattice: a block as eight particles and 28 springs, one between each pair (dissertation, section
//! 4.1).
//!
//! Particle i is at the signs (±1, ±1, ±1) times `g` from the centre; bit k of i is set for +1
//! along axis k. Surfaces follow the affine part of the particles' displacements, x = c + F l with
//! F = Σ_i p_i s_ik / (8 g_k) ⊗ e_k. A force at a point l of the surface acts on the particles by
//! virtual work, f_i = f / 8 + Σ_k f l_k s_ik / (8 g_k). With infinitely stiff springs a block is a
//! rigid body.
//!
//! The state is the best-fitting rigid pose and the displacements of the particles from their rest
//! positions in it. No spring length is formed from positions: in single precision its error would
//! exceed the strain under load.

pub mod affine;
pub mod particles;
pub mod springs;
#[cfg(test)]
mod tests;
