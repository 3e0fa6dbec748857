//! Lane arrays, and vectors in lanes.

use glam::DVec3;

use crate::simd::lanes::{LANES, Lanes, Real};

/// Array with one scalar for each lane.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(target_arch = "x86_64", repr(align(64)))]
pub struct LaneArray<R>(pub [R; LANES]);

impl<R: Real> LaneArray<R> {
    /// Array with the same number in each lane.
    pub fn splat(x: f64) -> Self {
        Self([R::from_f64(x); LANES])
    }
}

/// Vector in lane `l`.
pub fn get3<R: Real>(x: &[LaneArray<R>; 3], l: usize) -> DVec3 {
    DVec3::new(x[0].0[l].to_f64(), x[1].0[l].to_f64(), x[2].0[l].to_f64())
}

/// Sets the vector in lane `l`.
pub fn set3<R: Real>(to: &mut [LaneArray<R>; 3], l: usize, x: DVec3) {
    for k in 0..3 {
        to[k].0[l] = R::from_f64(x[k]);
    }
}

/// Loads one part of an array.
#[inline(always)]
pub fn load<L: Lanes>(from: &LaneArray<L::Scalar>, part: usize) -> L {
    L::load(&from.0, part)
}

/// Loads one part of a vector.
#[inline(always)]
pub fn load3<L: Lanes>(from: &[LaneArray<L::Scalar>; 3], part: usize) -> [L; 3] {
    [load(&from[0], part), load(&from[1], part), load(&from[2], part)]
}

/// Stores one part of a vector.
#[inline(always)]
pub fn store3<L: Lanes>(to: &mut [LaneArray<L::Scalar>; 3], part: usize, x: &[L; 3]) {
    x[0].store(&mut to[0].0, part);
    x[1].store(&mut to[1].0, part);
    x[2].store(&mut to[2].0, part);
}

/// Adds to one part of a vector.
#[inline(always)]
pub fn add3<L: Lanes>(to: &mut [LaneArray<L::Scalar>; 3], part: usize, x: &[L; 3]) {
    let at = load3::<L>(to, part);
    store3(to, part, &[at[0] + x[0], at[1] + x[1], at[2] + x[2]]);
}

/// Cross product.
#[inline(always)]
pub fn cross<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> [L; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Dot product.
#[inline(always)]
pub fn dot<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Components of a vector along the axes of a frame.
#[inline(always)]
pub fn into_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    [dot(&frame[0], v), dot(&frame[1], v), dot(&frame[2], v)]
}

/// Vector from its components along the axes of a frame.
#[inline(always)]
pub fn out_of_frame<L: Lanes>(frame: &[[L; 3]; 3], v: &[L; 3]) -> [L; 3] {
    let [x, y, z] = frame;
    [
        x[0] * v[0] + y[0] * v[1] + z[0] * v[2],
        x[1] * v[0] + y[1] * v[1] + z[1] * v[2],
        x[2] * v[0] + y[2] * v[1] + z[2] * v[2],
    ]
}
