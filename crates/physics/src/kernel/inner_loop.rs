//! Kernel: the packed cluster, and the loop of substeps over it in single or double precision.

use glam::DVec3;

use crate::actuator::cluster_input::Actuators;
use crate::body::BodyForce;
use crate::constants::BUDGET_CHECK_INTERVAL;
use crate::kernel::body_model::{BodyDelta, BodyModel};
use crate::kernel::contact_law::{ContactLaw, GroupPart, apply_contacts};
use crate::kernel::layout::{Group, Row};
use crate::params::Width;
use crate::simd::lanes::{LANES, Lanes, ROW_LEN, Real};
#[cfg(target_arch = "x86_64")]
use crate::simd::portable;

/// Lanes of the groups that pass each stage of the contact law together: their data fit into the L1
/// cache.
const STAGE_LANES: usize = 128;

/// Packed cluster for one frame, with bodies of model `B`.
#[derive(Debug, Clone, Default)]
pub struct Kernel<R, B> {
    /// Register width.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "other targets have a single width"))]
    pub width: Width,
    /// Contacts.
    pub groups: Vec<Group<R>>,
    /// Body twists at the cluster's reference point, so that relative motion is a difference of two
    /// rows. [`BodyModel::ROWS`] rows for each body; the last ones are the floor's and stay zero.
    pub velocity: Vec<Row<R>>,
    /// Weight and applied forces, constant during a batch, and their moments about the reference
    /// point.
    pub load: Vec<Row<R>>,
    /// Sums of forces of the current substep.
    pub force: Vec<Row<R>>,
    /// State of the bodies.
    pub bodies: Vec<B>,
    /// Number of bodies.
    pub len: usize,
    /// Substep, s.
    pub h: f64,
}

impl<R: Real, B: BodyModel<R>> Kernel<R, B> {
    /// Empty kernel with the given register width.
    pub fn new(width: Width) -> Self {
        Self {
            width,
            groups: Vec::new(),
            velocity: Vec::new(),
            load: Vec::new(),
            force: Vec::new(),
            bodies: Vec::new(),
            len: 0,
            h: 0.0,
        }
    }

    /// Resets the kernel to `n` bodies, at rest and without budgets, and substeps of `h` (s).
    pub fn resize(&mut self, n: usize, h: f64) {
        let blocks = n.div_ceil(LANES);
        // The rows of the floor follow those of the bodies.
        let rows = B::ROWS * (blocks * LANES + 1);
        (self.len, self.h) = (n, h);
        self.groups.clear();
        for all in [&mut self.velocity, &mut self.load, &mut self.force] {
            all.clear();
            all.resize(rows, Row::default());
        }
        self.bodies.clear();
        self.bodies.resize(blocks, B::empty());
    }

    /// Runs up to `substeps` substeps, fewer when a body uses up its budget. Returns their number.
    #[cfg(target_arch = "x86_64")]
    pub fn run(&mut self, law: &ContactLaw<R>, substeps: usize, actuators: &mut Actuators) -> usize {
        match self.width {
            Width::Portable => self.run_in::<portable::Plain<R>>(law, substeps, actuators),
            // SAFETY: the guard has checked that the processor has AVX-512.
            Width::Auto | Width::Avx512 if Width::Avx512.available() => unsafe {
                self.run_avx512(law, substeps, actuators)
            },
            // SAFETY: the guard has checked that the processor has AVX2.
            Width::Auto | Width::Avx512 | Width::Avx2 if Width::Avx2.available() => unsafe {
                self.run_avx2(law, substeps, actuators)
            },
            _ => self.run_in::<R::Base>(law, substeps, actuators),
        }
    }

    /// Runs up to `substeps` substeps, fewer when a body uses up its budget. Returns their number.
    ///
    /// Never inlined: WebAssembly engines sink what only one branch of the caller needs into that
    /// branch, even from outside a frame into its inner loop.
    #[cfg(not(target_arch = "x86_64"))]
    #[inline(never)]
    pub fn run(&mut self, law: &ContactLaw<R>, substeps: usize, actuators: &mut Actuators) -> usize {
        self.run_in::<R::Base>(law, substeps, actuators)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw")]
    fn run_avx512(&mut self, law: &ContactLaw<R>, substeps: usize, actuators: &mut Actuators) -> usize {
        self.run_in::<R::Avx512>(law, substeps, actuators)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn run_avx2(&mut self, law: &ContactLaw<R>, substeps: usize, actuators: &mut Actuators) -> usize {
        self.run_in::<R::Avx2>(law, substeps, actuators)
    }

    /// Loop of substeps with registers of type `L`.
    #[inline(always)]
    fn run_in<L: Lanes<Scalar = R>>(
        &mut self,
        law: &ContactLaw<R>,
        substeps: usize,
        actuators: &mut Actuators,
    ) -> usize {
        self.force.copy_from_slice(&self.load);
        self.assert_groups_within(&self.velocity);
        let mut parts: Vec<GroupPart<L, B::Motion<L>>> = self.groups.iter().flat_map(GroupPart::of).collect();
        for done in 0..substeps {
            let check = done % BUDGET_CHECK_INTERVAL == BUDGET_CHECK_INTERVAL - 1;
            let chunks = self.groups.chunks_mut(STAGE_LANES / LANES);
            for (groups, parts) in chunks.zip(parts.chunks_mut(STAGE_LANES / L::WIDTH)) {
                // SAFETY: all groups have been tested, and nothing here changes their bodies.
                unsafe { apply_contacts::<L, B>(groups, parts, law, &self.velocity, &mut self.force) };
            }
            self.apply_actuators(actuators);
            let mut exceeded = false;
            let velocity = self.velocity.chunks_exact_mut(B::ROWS * L::WIDTH);
            let rows = velocity
                .zip(self.force.chunks_exact_mut(B::ROWS * L::WIDTH))
                .zip(self.load.chunks_exact(B::ROWS * L::WIDTH));
            for (i, ((velocity, force), load)) in rows.take(self.len.div_ceil(L::WIDTH)).enumerate() {
                let (bodies, part) = (&mut self.bodies[i / (LANES / L::WIDTH)], i % (LANES / L::WIDTH));
                bodies.integrate::<L>(part, velocity, force, load);
                exceeded |= check && bodies.exceeds_budget::<L>(part, done + 1);
            }
            if exceeded {
                return done + 1;
            }
        }
        substeps
    }

    /// Adds the substeps of a batch to those since the last sync of each body.
    pub fn add_substeps(&mut self, substeps: usize) {
        self.bodies.iter_mut().for_each(|bodies| bodies.add_substeps(substeps));
    }

    /// Asserts that all groups are within `rows`, of which `force` has as many as `velocity`.
    ///
    /// # Panics
    /// When a group names a row that is not there: a fault of the packing.
    pub fn assert_groups_within(&self, rows: &[Row<R>]) {
        let is_within = |group: &Group<R>| group.is_within(rows.len(), B::ROWS);
        assert!(self.force.len() == self.velocity.len() && self.groups.iter().all(is_within));
    }

    /// Adds the forces of hand and drives.
    fn apply_actuators(&mut self, actuators: &mut Actuators) {
        if let Some(hand) = &mut actuators.hand {
            let i = hand.body();
            let force = hand.force(self.h, self.twist(i));
            self.add_force(i, &force);
        }
        for drive in &mut actuators.drives {
            let i = drive.body();
            let force = drive.force(self.h, self.twist(i));
            self.add_force(i, &force);
        }
    }

    /// Offset of the rows of body `i`, in scalars.
    pub fn row_offset(&self, i: u32) -> u32 {
        i * (B::ROWS * ROW_LEN) as u32
    }

    /// Offset of the rows of the floor, in scalars.
    pub fn floor_offset(&self) -> u32 {
        ((self.velocity.len() - B::ROWS) * ROW_LEN) as u32
    }

    /// Displacement (m) and rotation (rad) of a body since its last sync.
    pub fn displacement(&self, i: usize) -> (DVec3, DVec3) {
        self.bodies[i / LANES].displacement(i % LANES)
    }

    /// Displacement (m) and rotation (rad) of a body since its last sync beyond those of uniform
    /// motion.
    pub fn deviation(&self, i: usize) -> (DVec3, DVec3) {
        self.bodies[i / LANES].deviation(i % LANES)
    }

    /// Velocity of the centre (m/s) and spin (rad/s) of a body.
    pub fn twist(&self, i: usize) -> (DVec3, DVec3) {
        let (v, w) = self.bodies[i / LANES].twist(i % LANES);
        (v / self.h, w / self.h)
    }

    /// Change of a body since its last sync.
    pub fn delta(&self, i: usize) -> BodyDelta {
        self.bodies[i / LANES].delta(i % LANES, self.h)
    }

    /// Adds to the forces on a body in the current substep.
    fn add_force(&mut self, i: usize, force: &BodyForce) {
        let rows = B::ROWS * i..B::ROWS * (i + 1);
        self.bodies[i / LANES].add_force(i % LANES, force, &mut self.force[rows]);
    }
}
