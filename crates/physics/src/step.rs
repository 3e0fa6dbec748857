//! The step: the table of contents of the physics.

use crate::acts::{Acts, push};
use crate::cluster::Cluster;
use crate::frame::{Frame, Outcome};
use crate::input::Input;
use crate::lanes::float_mode::FloatMode;
use crate::moved::Moved;
use crate::report::StepReport;
use crate::world::World;

impl World {
    /// Advances the world by one frame and says what happened. Never fails: input that is not finite or names no body is passed
    /// over, and a body whose state runs away is quarantined and named in the report.
    ///
    /// With the feature `parallel`, bodies that are too far from each other to meet in a frame are stepped side by side in rayon's
    /// current thread pool; the bits are the same for any number of threads.
    pub fn step(&mut self, input: &Input) -> StepReport {
        let _mode = FloatMode::standard();
        let input = self.admissible(input);
        self.rouse(&input);
        self.regroup(&input);
        let outcomes = self.step_clusters(&input);
        self.remember(&input);
        self.summarise(&input, outcomes)
    }

    /// Makes the clusters such that none can touch another in the next frame.
    fn regroup(&mut self, input: &Input) {
        let push = push(input, self.aim.as_ref(), self.setup.frame, |i| self.mass(i));
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
