//! The step: the table of contents of the physics.

use crate::acts::{Acts, push};
use crate::cluster::Cluster;
use crate::frame::{Frame, Outcome};
use crate::input::Input;
use crate::moved::Moved;
use crate::report::StepReport;
use crate::simd::float_mode::FloatMode;
use crate::world::World;

impl World {
    /// Advances the world by one frame and reports on it. Never fails: input that is not finite or names
    /// no body is ignored, and a body whose state runs away is quarantined and listed in the report.
    ///
    /// With the feature `parallel`, bodies that cannot meet within a frame are stepped in parallel in
    /// rayon's current thread pool; the bits are the same for any number of threads.
    pub fn step(&mut self, input: &Input) -> StepReport {
        let _mode = FloatMode::standard();
        let input = self.sanitise(input);
        self.wake_targets(&input);
        self.regroup(&input);
        let outcomes = self.step_clusters(&input);
        self.store_input(&input);
        self.report(&input, outcomes)
    }

    /// Advances by `seconds`, rounded to whole frames and at least one, without input; returns the last
    /// report.
    pub fn run_for(&mut self, seconds: f64) -> StepReport {
        self.run_with(seconds, &Input::default())
    }

    /// Advances by `seconds`, rounded to whole frames and at least one, with the same input in each;
    /// returns the last report.
    pub fn run_with(&mut self, seconds: f64, input: &Input) -> StepReport {
        for _ in 1..self.frames(seconds) {
            self.step(input);
        }
        self.step(input)
    }

    /// Makes the clusters such that none can touch another in the next frame.
    fn regroup(&mut self, input: &Input) {
        let push = push(input, self.aim.as_ref(), self.setup.frame, |body| self.mass(body));
        self.clusters.regroup(&self.params, self.scene.form, self.setup.frame, &push);
    }

    /// Steps each cluster on its own.
    fn step_clusters(&mut self, input: &Input) -> Vec<Outcome> {
        let acts = Acts::of(input, self.aim, &self.forces, &self.clusters);
        let frame = Frame { setup: self.setup, start: self.time, gravity: self.gravity };
        #[cfg(feature = "parallel")]
        if self.clusters.list.iter().filter(|cluster| cluster.is_awake()).nth(1).is_some() {
            use rayon::prelude::*;
            return self
                .clusters
                .list
                .par_iter_mut()
                .zip(acts)
                .map(|(cluster, acts)| cluster.step(&frame, acts))
                .collect();
        }
        self.clusters.list.iter_mut().zip(acts).map(|(cluster, acts)| cluster.step(&frame, acts)).collect()
    }
}

impl Cluster {
    /// Advances the cluster by one frame.
    fn step(&mut self, frame: &Frame, mut acts: Acts) -> Outcome {
        // it may have a thread of its own
        let _mode = FloatMode::standard();
        let mut outcome = Outcome::default();
        if !self.is_awake() {
            return outcome;
        }
        self.begin(frame);
        let mut moved = Moved::all(self.len());
        let mut done = 0;
        while done < frame.setup.substeps {
            let batch = self.grant(frame, done, &mut moved, &mut outcome);
            self.pack(frame, &acts, done, batch, &moved);
            done += self.run(frame, &mut acts, done, batch, &mut outcome);
            moved = self.moved(frame, &acts, done);
            self.unload(frame, done, &moved);
            self.commit(frame, done, &mut moved, &mut outcome);
            self.detect(frame, done, &mut moved, &mut outcome);
            self.measure(&moved, &mut outcome);
        }
        self.rest(frame);
        outcome
    }
}
