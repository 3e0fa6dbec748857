//! Refinement in double precision of the tangential springs of a frame without a sync.
//!
//! A loaded spring is displaced by a micrometre, and single precision drops increments below 6e-14
//! m: the spring misses creep slower than 2 nm/s, and a slowly leaning tower would never stop. The
//! displacement of the bodies since the last sync is small and therefore accurate. A spring that
//! neither slid nor opened has changed by the displacement of its point, which is added to it in
//! double precision; the value of the loop only decides whether that holds.

use crate::kernel::body_model::{BodyModel, RelativeMotion};
use crate::kernel::inner_loop::Kernel;
use crate::kernel::layout::{Group, Row, SLOTS};
use crate::kernel::vector::{LaneArray, load, load3};
use crate::simd::lanes::{LANES, Lanes, Real};

/// Displacements of the contact points along their tangents and about their normals.
#[derive(Debug, Clone)]
pub struct TangentialRefine<R> {
    /// Displacements by group and slot, m.
    groups: Vec<[[LaneArray<R>; 3]; SLOTS]>,
    /// Largest relative rounding error accumulated in the substeps.
    rounding: f64,
    /// Largest magnitude from which the displacements of two bodies were accumulated, summed, m.
    largest: f64,
}

impl<R: Real> TangentialRefine<R> {
    /// Displacements of the points in the last `substeps`, in which no body was synced.
    pub fn new<B: BodyModel<R>>(kernel: &Kernel<R, B>, substeps: usize) -> Self {
        let mut rows = vec![Row::default(); kernel.velocity.len()];
        let mut largest = 0.0f64;
        for (i, rows) in rows.chunks_exact_mut(B::ROWS).take(kernel.len).enumerate() {
            largest = largest.max(2.0 * kernel.bodies[i / LANES].displacement_rows(i % LANES, rows));
        }
        let groups = kernel.groups.iter().map(|group| tangential::<R::Base, B>(group, &rows)).collect();
        Self { groups, rounding: substeps as f64 * R::HALF_ULP, largest }
    }

    /// Refined displacement of the tangential spring at an entry index and slot, m, from its
    /// displacement when it was packed (`before`) and that of the loop (`now`).
    pub fn refine(&self, before: [f64; 3], now: [R; 3], (index, slot): (usize, usize)) -> [f64; 3] {
        let change = self.groups[index / LANES][slot].map(|change| change.0[index % LANES].to_f64());
        let sticks = [0, 1, 2].map(|k| {
            let (packed, now) = (R::from_f64(before[k]).to_f64(), now[k].to_f64());
            (change[k] - (now - packed)).abs() <= self.rounding * (packed.abs().max(now.abs()) + self.largest)
        });
        if sticks == [true; 3] { [0, 1, 2].map(|k| before[k] + change[k]) } else { now.map(R::to_f64) }
    }
}

/// Displacements of the points of a group along their tangents and about the normal, from those of
/// the bodies in the layout of velocity rows.
fn tangential<L: Lanes, B: BodyModel<L::Scalar>>(
    group: &Group<L::Scalar>,
    rows: &[Row<L::Scalar>],
) -> [[LaneArray<L::Scalar>; 3]; SLOTS] {
    assert!(group.is_within(rows.len(), B::ROWS));
    let mut displacements = <[[LaneArray<L::Scalar>; 3]; SLOTS]>::default();
    for part in 0..LANES / L::WIDTH {
        let mut motion = B::Motion::<L>::zero();
        // SAFETY: the group has been tested.
        unsafe { B::relative_motion::<L>(group, part, rows, &mut motion) };
        for (point, to) in group.points.iter().zip(&mut displacements) {
            let arm = [load::<L>(&point.arm[0], part), load::<L>(&point.arm[1], part)];
            let friction_arm = load3::<L>(&point.friction_arm, part);
            let [_, u1, u2, turned] = motion.velocity_at(&arm, &friction_arm);
            u1.store(&mut to[0].0, part);
            u2.store(&mut to[1].0, part);
            turned.store(&mut to[2].0, part);
        }
    }
    displacements
}
