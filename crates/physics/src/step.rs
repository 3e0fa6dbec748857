//! Step: the table of contents of the physics.

use crate::actuator::cluster_input::{ClusterInput, input_speeds};
use crate::body_id::BodyId;
use crate::cluster::Cluster;
use crate::cluster::frame::{ClusterReport, Frame};
use crate::input::Input;
use crate::kernel::sync_set::SyncSet;
use crate::report::StepReport;
use crate::simd::float_mode::FloatMode;
use crate::world::World;

impl World {
    /// Advances the world by one frame and reports on it.
    ///
    /// A step never fails: input that is not finite or names no body is ignored, input above the
    /// limits of [`Input`] is reduced to them, and a body whose state runs away is quarantined and
    /// named in the report. With the feature `parallel`,
    /// clusters of bodies that cannot touch within the frame are stepped in rayon's current thread
    /// pool; the bits are the same for any number of threads.
    pub fn step(&mut self, input: &Input) -> StepReport {
        let _mode = FloatMode::standard();
        let input = self.sanitise(input);
        let put_in = self.wake_targets(&input);
        self.partition(&input);
        let reports = self.step_clusters(&input);
        self.store_input(&input);
        self.report(&input, reports, put_in)
    }

    /// Advances by `seconds`, rounded to whole frames and at least one, without input; returns the
    /// last report.
    pub fn run_for(&mut self, seconds: f64) -> StepReport {
        self.run_with(seconds, &Input::default())
    }

    /// Advances by `seconds`, rounded to whole frames and at least one, with the same input in
    /// each; returns the last report.
    pub fn run_with(&mut self, seconds: f64, input: &Input) -> StepReport {
        for _ in 1..self.frames(seconds) {
            self.step(input);
        }
        self.step(input)
    }

    /// Updates the clusters so that no two can touch in the next frame.
    fn partition(&mut self, input: &Input) {
        let shapes = |body: BodyId| {
            let (cluster, i) = self.clusters.get(body.0);
            (&cluster.shapes, i)
        };
        let speeds = input_speeds(input, (self.hand_target.as_ref(), &self.forces), self.derived.frame, shapes);
        self.clusters.partition(&self.params, self.scene.form, self.derived.frame, &speeds);
    }

    /// Steps each cluster independently.
    fn step_clusters(&mut self, input: &Input) -> Vec<ClusterReport> {
        let locations = (self.clusters.list.len(), self.clusters.locations.as_slice());
        let inputs = ClusterInput::split(input, self.hand_target, &self.forces, locations);
        let frame = Frame { derived: self.derived, start: self.time, gravity: self.gravity };
        #[cfg(feature = "parallel")]
        if self.clusters.list.iter().filter(|cluster| cluster.is_awake()).nth(1).is_some() {
            use rayon::prelude::*;
            let clusters = self.clusters.list.par_iter_mut().zip(inputs);
            return clusters.map(|(cluster, input)| cluster.step(&frame, input)).collect();
        }
        self.clusters.list.iter_mut().zip(inputs).map(|(cluster, input)| cluster.step(&frame, input)).collect()
    }
}

impl Cluster {
    /// Advances the cluster by one frame.
    fn step(&mut self, frame: &Frame, mut input: ClusterInput) -> ClusterReport {
        // The mode is set for each thread.
        let _mode = FloatMode::standard();
        let mut report = ClusterReport::default();
        if !self.is_awake() {
            return report;
        }
        self.begin_frame(frame, &input);
        let mut synced = SyncSet::all(self.len());
        let mut done = 0;
        while done < frame.derived.substeps {
            let batch = self.plan_batch(frame, done, &mut synced, &mut report);
            self.pack(frame, &input, batch, &synced);
            done += self.run_batch(frame, &mut input, batch, &mut report);
            synced = self.bodies_to_sync(frame, &input, done);
            self.unpack(frame, done, &synced);
            self.sync_poses(frame, done, &mut synced, &mut report);
            self.detect(frame, done, &mut synced, &mut report);
            self.update_gaps(&synced, &mut report);
        }
        self.update_rest(frame);
        report
    }
}
