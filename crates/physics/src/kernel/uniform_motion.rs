//! Uniform motion in lanes, and how far bodies have deviated from it.

use glam::DVec3;

use crate::kernel::body_model::{KernelBody, UniformMotion};
use crate::kernel::vector::{LaneArray, dot, get3, load3, set3};
use crate::simd::lanes::{Lanes, Real};

/// Vectors of the centre and of the turning of bodies, one for each lane.
type Motion<R> = [[LaneArray<R>; 3]; 2];

/// Sets the uniform motion (m and rad per substep) and the deviation (m, rad) of lane `l`.
pub fn load_uniform<R: Real>((uniform, deviated): (&mut Motion<R>, &mut Motion<R>), l: usize, body: &KernelBody) {
    let UniformMotion { velocity, spin, deviation } = body.uniform;
    set3(&mut uniform[0], l, velocity * body.h);
    set3(&mut uniform[1], l, spin * body.h);
    set3(&mut deviated[0], l, deviation.0);
    set3(&mut deviated[1], l, deviation.1);
}

/// Displacement (m) and rotation (rad) of lane `l` beyond those of uniform motion, after those
/// since the last sync and their number of substeps.
pub fn deviation<R: Real>(
    (uniform, deviated): (&Motion<R>, &Motion<R>),
    l: usize,
    ((displacement, rotation), substeps): ((DVec3, DVec3), f64),
) -> (DVec3, DVec3) {
    let beyond = |k: usize, moved: DVec3| get3(&deviated[k], l) + moved - get3(&uniform[k], l) * substeps;
    (beyond(0, displacement), beyond(1, rotation))
}

/// Square of the deviation of the points of bodies with these radii (m), m²; the arguments are
/// those of [`deviation`] for one part.
#[inline(always)]
pub fn squared_deviation<L: Lanes>(
    (uniform, deviated): (&Motion<L::Scalar>, &Motion<L::Scalar>),
    part: usize,
    (moved, substeps): (&[[L; 3]; 2], L),
    radius: L,
) -> L {
    let mut squares = [L::zero(); 2];
    // A closure would be compiled for the registers of the target.
    for k in 0..2 {
        let (uniform, deviated) = (load3::<L>(&uniform[k], part), load3::<L>(&deviated[k], part));
        let x = (moved[k][0] - uniform[0] * substeps) + deviated[0];
        let y = (moved[k][1] - uniform[1] * substeps) + deviated[1];
        let z = (moved[k][2] - uniform[2] * substeps) + deviated[2];
        squares[k] = dot(&[x, y, z], &[x, y, z]);
    }
    squares[0] + squares[1] * (radius * radius)
}
