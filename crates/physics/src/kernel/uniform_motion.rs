//! Uniform motion of bodies, and how far they have deviated from it.

use glam::DVec3;

use crate::constants::UNLIMITED;
use crate::kernel::body_model::{KernelBody, UniformMotion};
use crate::kernel::vector::{LaneArray, dot, get3, load, load3, set3};
use crate::simd::lanes::{Lanes, Real};

/// Uniform motion of bodies, one for each lane, and the deviation that ends the batch.
#[derive(Debug, Clone, Copy)]
pub struct Deviation<R> {
    /// Velocity and spin, m and rad per substep.
    uniform: [[LaneArray<R>; 3]; 2],
    /// Displacement and rotation by which the body had deviated at the last sync, m and rad.
    deviated: [[LaneArray<R>; 3]; 2],
    /// Substeps since the last sync.
    substeps: LaneArray<R>,
    /// Distance from the centre to a corner, m.
    radius: LaneArray<R>,
    /// Deviation of the points of a body that ends the batch, m.
    budget: LaneArray<R>,
    /// True if any budget is limited.
    is_limited: bool,
}

impl<R: Real> Deviation<R> {
    /// Bodies at rest without budgets.
    pub fn empty() -> Self {
        let zero = LaneArray::default();
        Self {
            uniform: [[zero; 3]; 2],
            deviated: [[zero; 3]; 2],
            substeps: zero,
            radius: zero,
            budget: LaneArray::splat(UNLIMITED),
            is_limited: false,
        }
    }

    /// Sets the body in lane `l`.
    pub fn load(&mut self, l: usize, body: &KernelBody) {
        let UniformMotion { velocity, spin, deviation } = body.uniform;
        set3(&mut self.uniform[0], l, velocity * body.h);
        set3(&mut self.uniform[1], l, spin * body.h);
        set3(&mut self.deviated[0], l, deviation.0);
        set3(&mut self.deviated[1], l, deviation.1);
        self.substeps.0[l] = R::from_f64(0.0);
        self.radius.0[l] = R::from_f64(body.radius);
        self.budget.0[l] = R::from_f64(body.deviation_budget);
        self.is_limited = self.budget.0.iter().any(|budget| budget.to_f64() < 0.5 * UNLIMITED);
    }

    /// Adds the substeps of a batch to those since the last sync.
    pub fn add_substeps(&mut self, substeps: usize) {
        for to in &mut self.substeps.0 {
            *to = *to + R::from_f64(substeps as f64);
        }
    }

    /// Displacement (m) and rotation (rad) of the body in lane `l` beyond those of uniform motion,
    /// after those since the last sync.
    pub fn after(&self, l: usize, (displacement, rotation): (DVec3, DVec3)) -> (DVec3, DVec3) {
        let substeps = self.substeps.0[l].to_f64();
        let beyond = |k: usize, moved: DVec3| get3(&self.deviated[k], l) + moved - get3(&self.uniform[k], l) * substeps;
        (beyond(0, displacement), beyond(1, rotation))
    }

    /// Returns true if any deviation is limited.
    #[inline(always)]
    pub fn is_limited(&self) -> bool {
        self.is_limited
    }

    /// Returns true if a body of one part has used up its budget, after `substeps` substeps of a
    /// batch and a displacement and rotation since the last sync.
    #[inline(always)]
    pub fn exceeds_budget<L: Lanes<Scalar = R>>(&self, part: usize, substeps: usize, moved: &[[L; 3]; 2]) -> bool {
        let substeps = load::<L>(&self.substeps, part) + L::splat_f64(substeps as f64);
        let mut squares = [L::zero(); 2];
        // A closure would be compiled for the registers of the target.
        for k in 0..2 {
            let (uniform, deviated) = (load3::<L>(&self.uniform[k], part), load3::<L>(&self.deviated[k], part));
            let x = (moved[k][0] - uniform[0] * substeps) + deviated[0];
            let y = (moved[k][1] - uniform[1] * substeps) + deviated[1];
            let z = (moved[k][2] - uniform[2] * substeps) + deviated[2];
            squares[k] = dot(&[x, y, z], &[x, y, z]);
        }
        let (radius, budget) = (load::<L>(&self.radius, part), load::<L>(&self.budget, part));
        L::any((budget * budget).less_than(squares[0] + squares[1] * (radius * radius)))
    }
}
