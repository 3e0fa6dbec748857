//! Frame of a cluster: the work between two runs of the inner loop, done for the bodies that are
//! synced.

use glam::DVec3;

use crate::actuator::cluster_input::ClusterInput;
use crate::actuator::hand::BatchTime;
use crate::body::FLOOR;
use crate::cluster::Cluster;
use crate::cluster::{energy, rest, sync, travel_budget};
use crate::collision::contacts::{Contacts, needs_detection};
use crate::collision::passivity::fade;
use crate::constants::{MIN_SWEEP, SYNC_SHARE, SYNC_TIME, UNLIMITED};
use crate::derived::Derived;
use crate::kernel::any_kernel::with_kernel;
use crate::kernel::body_model::{BodyDelta, UniformMotion};
use crate::kernel::contact_law::ContactLaw;
use crate::kernel::packing::PackInput;
use crate::kernel::sync_set::SyncSet;
use crate::kernel::tangential_refine::TangentialRefine;
use crate::lattice::particles::zero_velocities;
use crate::report::HandReport;

/// Frame to step, the same for all clusters.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub derived: Derived,
    /// Time at the start of the frame, s.
    pub start: f64,
    /// Gravity at the end of the ramp, m/s².
    pub gravity: DVec3,
}

/// Batch of substeps between two syncs.
#[derive(Debug, Clone, Copy)]
pub struct Batch {
    /// Substeps of the frame before the batch.
    pub start: usize,
    /// Substeps of the batch.
    pub substeps: usize,
}

impl Frame {
    /// Gravity after `done` substeps, m/s²: it grows linearly during the ramp.
    fn gravity_at(&self, done: usize) -> DVec3 {
        let time = self.start + done as f64 * self.derived.h;
        if time < self.derived.ramp { self.gravity * (time / self.derived.ramp).clamp(0.0, 1.0) } else { self.gravity }
    }

    /// Returns true if gravity has its full value.
    fn is_ramp_over(&self) -> bool {
        self.start > self.derived.ramp
    }

    /// Substep of the next sync of all moving bodies, after `done` substeps.
    fn next_sync(&self, done: usize) -> usize {
        let interval = ((SYNC_TIME / self.derived.h).round() as usize).max(1);
        ((done / interval + 1) * interval).min(self.derived.substeps)
    }
}

/// Report on a frame of one cluster.
#[derive(Debug, Clone, Default)]
pub struct ClusterReport {
    /// Substeps run.
    pub substeps: u32,
    /// Batches run.
    pub syncs: u32,
    /// Pairs tested by detection.
    pub detections: u32,
    /// Deepest penetration, m.
    pub penetration: f64,
    /// Indices in the cluster of the bodies quarantined.
    pub quarantined: Vec<u32>,
    /// Work of the input on the bodies, J.
    pub work: f64,
    /// Force and torque of the hand, if it holds a body of the cluster.
    pub hand: Option<HandReport>,
}

impl Cluster {
    /// Resets packing and kernel for a frame, and enters its energy.
    pub fn begin_frame(&mut self, frame: &Frame, input: &ClusterInput) {
        self.energy = energy::entered(self, &frame.derived, frame.gravity, input);
        self.packing.reset(&self.bodies);
        for manifold in self.contacts.manifolds.iter_mut().filter(|manifold| manifold.free_depth > 0.0) {
            fade(manifold, frame.derived.frame, &self.shapes, &self.bodies);
        }
        with_kernel!(self.kernel, |kernel| kernel.resize(self.bodies.len(), frame.derived.h));
    }

    /// Plans the next batch: sets the budgets of the synced bodies, and wakes bodies that may be
    /// touched.
    pub fn plan_batch(
        &mut self,
        frame: &Frame,
        done: usize,
        synced: &mut SyncSet,
        report: &mut ClusterReport,
    ) -> Batch {
        let speeds = travel_budget::predict_speeds(&self.shapes, &self.bodies, &self.contacts.manifolds);
        let quiet = frame.is_ramp_over() && speeds.iter().all(|&speed| travel_budget::is_quiet(speed));
        let end = if quiet { frame.derived.substeps } else { frame.next_sync(done) };
        let time = (end - done) as f64 * frame.derived.h;
        self.set_travel_budgets(synced, &speeds, time);
        let disturbed = rest::find_disturbed(&self.bodies, &self.contacts.manifolds, &self.packing.travel_budget);
        if !disturbed.is_empty() {
            rest::wake(&mut self.bodies, &self.contacts.manifolds, &disturbed);
            self.sync_all(frame, done, synced, report);
            self.set_travel_budgets(synced, &speeds, time);
        }
        Batch { start: done, substeps: end - done }
    }

    /// Sets the budgets of travel and deviation of the synced bodies for `time` (s) at the
    /// predicted speeds (m/s).
    fn set_travel_budgets(&mut self, synced: &SyncSet, speeds: &[f64], time: f64) {
        let Self { shapes, bodies, contacts, packing, .. } = self;
        let (travel, deviation) = (&mut packing.travel_budget, &mut packing.deviation_budget);
        for i in synced.iter() {
            travel[i] = travel_budget::travel_budget(shapes, bodies, i, speeds[i], time);
            deviation[i] = UNLIMITED;
        }
        for i in synced.adjacent.iter().map(|&i| i as usize) {
            travel[i] = travel[i].min(travel_budget::remaining_margin(shapes, bodies, i));
        }
        for cached in contacts.cache.iter().filter(|cached| synced.touches(cached.pair[0], cached.pair[1])) {
            let budgets = travel_budget::PairBudgets::new(shapes, bodies, cached);
            for i in cached.pair.into_iter().filter(|&i| i != FLOOR).map(|i| i as usize) {
                let speed = bodies.max_point_speed(shapes, i);
                travel[i] = travel[i].min(budgets.travel(speed));
                // The travel of a quiet body is its deviation.
                if !travel_budget::is_quiet(speed) {
                    deviation[i] = deviation[i].min(budgets.deviation);
                }
            }
        }
    }

    /// Extends the sync to all bodies.
    fn sync_all(&mut self, frame: &Frame, done: usize, synced: &mut SyncSet, report: &mut ClusterReport) {
        if synced.all {
            return;
        }
        *synced = SyncSet::all(self.len());
        self.unpack(frame, done, synced);
        self.sync_poses(frame, done, synced, report);
        self.update_gaps(synced, report);
    }

    /// Packs the synced bodies and their contacts for a batch.
    pub fn pack(&mut self, frame: &Frame, cluster_input: &ClusterInput, batch: Batch, synced: &SyncSet) {
        let progress = (batch.start as f64 + 0.5 * batch.substeps as f64) / frame.derived.substeps as f64;
        let gravity = frame.gravity_at(batch.start);
        let Self { shapes, bodies, particles, contacts, packing, kernel, .. } = self;
        let time = batch.substeps as f64 * frame.derived.h;
        let input = PackInput { shapes, bodies, particles, derived: &frame.derived, time };
        with_kernel!(*kernel, |kernel| {
            packing.pack(kernel, contacts, &input, synced);
            for i in synced.iter().chain(synced.adjacent.iter().map(|&i| i as usize)) {
                let (force, torque) = cluster_input.force(shapes, bodies, i, progress);
                packing.load[i] = (shapes.mass[i] * gravity + force, torque);
                if synced.members[i] {
                    packing.uniform[i] = UniformMotion {
                        velocity: bodies.velocity[i],
                        spin: bodies.spin[i],
                        deviation: (DVec3::ZERO, DVec3::ZERO),
                    };
                    packing.rotation_budget[i] =
                        travel_budget::rotation_budget(shapes, bodies, i, packing.has_contacts(i));
                }
                packing.synced_at[i] = batch.start;
                packing.load_body(kernel, &input, i, cluster_input.bodies().any(|j| j == i));
            }
        });
    }

    /// Runs a batch in the inner loop; returns the number of substeps done.
    pub fn run_batch(
        &mut self,
        frame: &Frame,
        cluster_input: &mut ClusterInput,
        batch: Batch,
        report: &mut ClusterReport,
    ) -> usize {
        report.syncs += 1;
        if !self.is_awake() {
            return batch.substeps;
        }
        let time = BatchTime {
            progress: batch.start as f64 / frame.derived.substeps as f64,
            frame: frame.derived.frame,
            gravity: frame.gravity_at(batch.start),
        };
        let mut actuators = cluster_input.actuators(&time, &self.shapes, &self.bodies);
        let law = &frame.derived;
        let done = with_kernel!(self.kernel, |kernel| {
            let done = kernel.run(&ContactLaw::new(law), batch.substeps, &mut actuators);
            kernel.add_substeps(done);
            done
        });
        report.substeps += done as u32;
        report.work += with_kernel!(self.kernel, |kernel| actuators.work(law.h, |i| kernel.twist(i)));
        report.hand = actuators.hand.map(|hand| hand.report);
        done
    }

    /// Bodies to sync after `done` substeps: those that have used a good part of their budgets;
    /// those that move at all, at regular times; and all at the end of the frame and during the
    /// ramp.
    pub fn bodies_to_sync(&mut self, frame: &Frame, cluster_input: &ClusterInput, done: usize) -> SyncSet {
        let n = self.len();
        if done == frame.derived.substeps || !frame.is_ramp_over() {
            return SyncSet::all(n);
        }
        let regular = frame.next_sync(done - 1) == done;
        let mut members = vec![false; n];
        for (i, member) in members.iter_mut().enumerate().filter(|&(i, _)| self.bodies.is_active(i)) {
            let (displacement, rotation) = with_kernel!(self.kernel, |kernel| kernel.displacement(i));
            let (v, w) = with_kernel!(self.kernel, |kernel| kernel.twist(i));
            let at_points =
                |(center, turning): (DVec3, DVec3)| center.length() + turning.length() * self.shapes.radius[i];
            let deviation = at_points(with_kernel!(self.kernel, |kernel| kernel.deviation(i)));
            let used = at_points((displacement, rotation)) > SYNC_SHARE * self.packing.travel_budget[i]
                || rotation.length() > SYNC_SHARE * self.packing.rotation_budget[i]
                || deviation > SYNC_SHARE * self.packing.deviation_budget[i];
            let speed = at_points((v, w));
            *member = used || (regular && !travel_budget::is_quiet(speed));
        }
        // Forces of the input change from batch to batch.
        cluster_input.bodies().for_each(|i| members[i] = true);
        SyncSet::new(members)
    }

    /// Stores the springs of the synced bodies in the manifolds, refined after a frame without a
    /// sync.
    pub fn unpack(&mut self, frame: &Frame, done: usize, synced: &SyncSet) {
        let Self { contacts, packing, kernel, .. } = self;
        let substeps = frame.derived.substeps;
        let unsynced = done == substeps && packing.synced_at.iter().all(|&synced_at| synced_at == 0);
        with_kernel!(*kernel, |kernel| {
            let refine = unsynced.then(|| TangentialRefine::new(kernel, substeps));
            packing.unpack(kernel, contacts, synced, refine.as_ref());
        });
    }

    /// Syncs the poses of the bodies in the set, and of those in contact with them.
    pub fn sync_poses(&mut self, frame: &Frame, done: usize, synced: &mut SyncSet, report: &mut ClusterReport) {
        if !synced.all {
            let touching = self.contacts.manifolds.iter().map(|manifold| [manifold.a, manifold.b]);
            for [a, b] in touching.chain(self.contacts.cache.iter().map(|cached| cached.pair)) {
                if synced.touches(a, b) {
                    synced.add_adjacent(a);
                    synced.add_adjacent(b);
                }
            }
        }
        for i in synced.iter().collect::<Vec<_>>() {
            self.sync_body(frame, done, i, report);
        }
        for i in synced.adjacent.clone() {
            self.sync_body(frame, done, i as usize, report);
        }
    }

    /// Syncs the pose of a body, unless that has been done after `done` substeps.
    fn sync_body(&mut self, frame: &Frame, done: usize, i: usize, report: &mut ClusterReport) {
        if !self.bodies.is_active(i) || self.packing.synced_at[i] == done {
            return;
        }
        let time = (done - self.packing.synced_at[i]) as f64 * frame.derived.h;
        let mut delta = with_kernel!(self.kernel, |kernel| kernel.delta(i));
        self.packing.uniform[i].deviation = with_kernel!(self.kernel, |kernel| kernel.deviation(i));
        let ballistic = self.packing.ballistic[i];
        if ballistic {
            let acceleration = self.packing.load[i].0 / self.shapes.mass[i];
            sync::integrate_ballistic(&self.bodies, i, acceleration, time, &mut delta);
        }
        self.packing.synced_at[i] = done;
        if !sync::is_valid(&self.shapes, &self.bodies, i, &delta, self.energy) {
            sync::quarantine(&mut self.bodies, &mut self.contacts, i);
            report.quarantined.push(i as u32);
            return;
        }
        self.packing.travel_budget[i] -= delta.displacement.length() + delta.rotation.length() * self.shapes.radius[i];
        self.packing.rotation_budget[i] -= delta.rotation.length();
        report.work += self.load_work(frame, i, &delta);
        match (&delta.particles, self.particles.get_mut(i)) {
            (Some(moved), Some(particles)) => {
                let flight = ballistic.then_some((delta.displacement, delta.velocity));
                let delta = sync::ParticleDelta { particles: moved, flight, time };
                sync::advance_lattice(&self.shapes, &mut self.bodies, i, particles, &delta);
            }
            _ => sync::advance_rigid(&self.shapes, &mut self.bodies, i, &delta, time),
        }
    }

    /// Work on body `i` of its load beyond its full weight, J: of applied forces, and of what
    /// gravity lacks during the ramp.
    fn load_work(&self, frame: &Frame, i: usize, delta: &BodyDelta) -> f64 {
        let (force, torque) = self.packing.load[i];
        // As for actuators: the mean of the velocities before and after each substep counts.
        let lag = if self.packing.ballistic[i] { 0.0 } else { 0.5 * frame.derived.h };
        let displacement = delta.displacement + lag * (delta.velocity - self.bodies.velocity[i]);
        let rotation = delta.rotation + lag * (delta.spin - self.bodies.spin[i]);
        (force - self.shapes.mass[i] * frame.gravity).dot(displacement) + torque.dot(rotation)
    }

    /// Renews the bounds of synced bodies that have left their margins, and tests the pairs of
    /// which the last test no longer holds.
    pub fn detect(&mut self, frame: &Frame, done: usize, synced: &mut SyncSet, report: &mut ClusterReport) {
        let due: Vec<u32> =
            synced.iter().filter(|&i| needs_detection(&self.shapes, &self.bodies, i)).map(|i| i as u32).collect();
        let is_synced = |low, high| synced.touches(low, high);
        let mut moved = self.contacts.due_pairs(&self.shapes, &self.bodies, &due, is_synced);
        if due.is_empty() && moved.is_empty() {
            return;
        }
        let left = (frame.derived.substeps - done) as f64 * frame.derived.h;
        let growth = MIN_SWEEP + 2.0 * self.max_speed() * left;
        let mut pairs = self.contacts.candidate_pairs(&self.shapes, &mut self.bodies, &due, growth);
        pairs.append(&mut moved);
        let before = synced.adjacent.len();
        if !synced.all {
            for &(low, high) in &pairs {
                synced.add_adjacent(if low == FLOOR { high } else { low });
                synced.add_adjacent(high);
            }
        }
        for i in synced.adjacent[before..].iter().copied() {
            self.sync_body(frame, done, i as usize, report);
        }
        report.detections += self.contacts.detect(&self.shapes, &self.bodies, &due, &pairs) as u32;
    }

    /// Recomputes the gaps of the contacts of synced bodies.
    pub fn update_gaps(&mut self, synced: &SyncSet, report: &mut ClusterReport) {
        for manifold in &mut self.contacts.manifolds {
            if synced.touches(manifold.a, manifold.b) {
                report.penetration =
                    report.penetration.max(Contacts::update_gaps(&self.shapes, &self.bodies, manifold));
            }
        }
    }

    /// Updates the times at rest, and puts islands to sleep where that is allowed.
    pub fn update_rest(&mut self, frame: &Frame) {
        rest::update_rest(&self.shapes, &mut self.bodies, frame.derived.frame);
        if frame.derived.sleep && frame.start + frame.derived.frame > frame.derived.ramp {
            rest::sleep(&mut self.bodies, &self.contacts.manifolds);
            zero_velocities(&self.bodies, &mut self.particles);
        }
    }
}
