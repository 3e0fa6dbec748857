//! Vectors of scalars, one type for each register width of the supported machines.
//!
//! Every operation rounds each lane as the scalar operation does, and only a transposition moves
//! data between lanes: all widths give the same bits. Deliberately absent: fused multiply-add,
//! reciprocal estimates and horizontal sums.

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
pub mod float_mode;
pub mod lanes;
pub mod portable;
pub mod real;
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
mod register;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub mod simd128;
#[cfg(target_arch = "x86_64")]
pub mod sse2;
#[cfg(test)]
mod tests;
