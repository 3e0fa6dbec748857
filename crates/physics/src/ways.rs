//! The tangential springs of a frame without a sync, to the last digit.
//!
//! A spring that carries load is a micrometre long, and single precision adds nothing below 6e-14 m to it: at each substep it does not
//! feel a creep of less than 2 nm/s, and nothing holds a tower that leans by as little. What bodies have done since the last sync is known
//! to the last digit. A spring that neither slid nor opened has grown by just the way of its point, and that is what goes on in double
//! precision; what the loop added up says only whether it did.

use crate::form::{Form, Motion};
use crate::kernel::{Group, Kernel, Lane, Row, SLOTS, load};
use crate::simd::lanes::{LANES, Lanes, Real};

/// Ways of the points along the tangents.
#[derive(Debug, Clone)]
pub struct Ways<R> {
    /// Of each group, m.
    groups: Vec<[[Lane<R>; 2]; SLOTS]>,
    /// Most that so many substeps lose of a number, over the number.
    loss: f64,
    /// Largest of the numbers from which two bodies have done their ways, together, m.
    largest: f64,
}

impl<R: Real> Ways<R> {
    /// What the points have done in the last `substeps`, since when neither of their bodies was synced.
    pub fn of<F: Form<R>>(kernel: &Kernel<R, F>, substeps: usize) -> Self {
        let mut rows = vec![Row::default(); kernel.velocity.len()];
        let mut largest = 0.0f64;
        for (i, rows) in rows.chunks_exact_mut(F::ROWS).take(kernel.len).enumerate() {
            largest = largest.max(2.0 * kernel.bodies[i / LANES].way(i % LANES, rows));
        }
        let groups = kernel.groups.iter().map(|group| along::<R::Base, F>(group, &rows)).collect();
        Self { groups, loss: substeps as f64 * R::HALF_ULP, largest }
    }

    /// How far a spring is stretched that was `before` when it was packed and is `now` by the loop, m, at the lane and slot given.
    pub fn stretched(&self, before: [f64; 2], now: [R; 2], (at, slot): (usize, usize)) -> [f64; 2] {
        let way = self.groups[at / LANES][slot].map(|way| way.0[at % LANES].to_f64());
        let felt = [0, 1].map(|k| {
            let (packed, now) = (R::from_f64(before[k]).to_f64(), now[k].to_f64());
            (way[k] - (now - packed)).abs() <= self.loss * (packed.abs().max(now.abs()) + self.largest)
        });
        if felt == [true; 2] { [before[0] + way[0], before[1] + way[1]] } else { now.map(R::to_f64) }
    }
}

/// What the points of a group have done along their tangents, from the ways of the bodies laid out as velocities.
fn along<L: Lanes, F: Form<L::Scalar>>(
    group: &Group<L::Scalar>,
    rows: &[Row<L::Scalar>],
) -> [[Lane<L::Scalar>; 2]; SLOTS] {
    let mut ways = <[[Lane<L::Scalar>; 2]; SLOTS]>::default();
    for part in 0..LANES / L::WIDTH {
        let mut motion = F::Motion::<L>::still();
        F::relative::<L>(group, part, rows, &mut motion);
        for (point, to) in group.points.iter().zip(&mut ways) {
            let arm = [load::<L>(&point.arm[0], part), load::<L>(&point.arm[1], part)];
            let lever = [load::<L>(&point.lever[0], part), load::<L>(&point.lever[1], part)];
            let [_, u1, u2] = motion.at(&arm, &lever);
            u1.store(&mut to[0].0, part);
            u2.store(&mut to[1].0, part);
        }
    }
    ways
}
