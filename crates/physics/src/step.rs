//! The step: the table of contents of the physics.

use glam::DVec3;

use crate::batch;
use crate::contacts::due;
use crate::drive::Servo;
use crate::hand::{Aim, Pull};
use crate::input::Input;
use crate::kernel::Actors;
use crate::lanes::float_mode::FloatMode;
use crate::pack::{Batch, motion};
use crate::report::StepReport;
use crate::rest;
use crate::sync;
use crate::world::{Loop, World};

impl World {
    /// Advances the world by one frame and says what happened. Never fails: input that is not finite or names no body is passed
    /// over, and a body whose state runs away is quarantined and named in the report.
    pub fn step(&mut self, input: &Input) -> StepReport {
        let _mode = FloatMode::standard();
        let input = self.admissible(input);
        let mut report = StepReport::default();
        self.rouse(&input);
        let mut left = self.substeps;
        while left > 0 {
            let gravity = self.gravity(&input);
            let speeds = batch::speeds(&self.shapes, &self.state.bodies, &self.state.contacts.manifolds);
            let wanted = self.substeps_until_sync(&speeds).min(left);
            let batch = self.batch(&input, &speeds, gravity, wanted, left);
            let done = self.run(&input, &batch, gravity, wanted, left, &mut report);
            self.commit(&batch, done, &mut report);
            self.detect(&mut report);
            self.state.contacts.measure(&self.state.bodies);
            report.penetration = report.penetration.max(self.penetration());
            report.substeps += done as u32;
            report.syncs += 1;
            left -= done;
        }
        self.remember(&input);
        self.rest();
        self.summarise(&input, &mut report);
        report
    }

    /// What the inner loop needs to know for up to `wanted` substeps.
    fn batch(&mut self, input: &Input, speeds: &[f64], gravity: DVec3, wanted: usize, left: usize) -> Batch {
        let (shapes, state) = (&self.shapes, &mut self.state);
        let travel = batch::travel(shapes, &state.bodies, speeds, wanted as f64 * self.h);
        let disturbed = rest::disturbed(&state.bodies, &state.contacts.manifolds, &travel);
        rest::wake(&mut state.bodies, &state.contacts.manifolds, &disturbed);
        let held = (0..state.bodies.len()).map(|i| !state.bodies.moves(i)).collect();
        let mut load = batch::weights(shapes, gravity);
        let share = 1.0 - (left as f64 - 0.5 * wanted as f64) / self.substeps as f64;
        for applied in &input.forces {
            let i = applied.body as usize;
            let before = state.forces.iter().find(|f| f.body == applied.body && f.point == applied.point);
            let before = before.map_or(DVec3::ZERO, |f| f.force);
            let force = before + (applied.force - before) * share;
            load[i].0 += force;
            load[i].1 += (state.bodies.orientation[i] * applied.point).cross(force);
        }
        Batch { h: self.h, mu: self.mu, zeta: self.zeta, stiffness: self.stiffness, travel, load, held }
    }

    /// Packs, runs the inner loop and unpacks the springs; returns the substeps done.
    fn run(&mut self, input: &Input, batch: &Batch, gravity: DVec3, wanted: usize, left: usize, report: &mut StepReport) -> usize {
        if batch.held.iter().all(|&held| held) {
            return wanted;
        }
        let (shapes, state) = (&self.shapes, &mut self.state);
        let hand = input.hand.as_ref().map(|hand| {
            let from = match &state.aim {
                Some(aim) if aim.body == hand.body => *aim,
                _ => Aim::of_grasp(hand, &state.bodies),
            };
            state.aim = Some(from);
            let share = 1.0 - left as f64 / self.substeps as f64;
            Pull::new(hand, &from, share, self.params.frame, gravity, shapes, &state.bodies)
        });
        let drives = input.drives.iter().map(|d| Servo::new(d, shapes, &state.bodies)).collect();
        let mut actors = Actors { hand, drives };
        let manifolds = &mut state.contacts.manifolds;
        self.packing.plan(manifolds, batch);
        for i in actors.bodies().chain(input.forces.iter().map(|f| f.body as usize)) {
            self.packing.free[i] = false;
        }
        let done = match &mut self.kernel {
            Loop::Single(kernel) => {
                let law = self.packing.load(kernel, manifolds, shapes, &state.bodies, batch);
                let done = kernel.run(&law, wanted, &mut actors);
                self.packing.unload(kernel, manifolds);
                done
            }
            Loop::Double(kernel) => {
                let law = self.packing.load(kernel, manifolds, shapes, &state.bodies, batch);
                let done = kernel.run(&law, wanted, &mut actors);
                self.packing.unload(kernel, manifolds);
                done
            }
        };
        report.hand = actors.hand.map(|hand| hand.report);
        done
    }

    /// Makes the displacements of `done` substeps into poses.
    fn commit(&mut self, batch: &Batch, done: usize, report: &mut StepReport) {
        let time = done as f64 * self.h;
        self.state.time += time;
        for i in 0..self.state.bodies.len() {
            if !self.state.bodies.moves(i) {
                continue;
            }
            let motion = match &self.kernel {
                _ if self.packing.free[i] => sync::fly(&self.shapes, &self.state.bodies, i, batch.load[i].0, time),
                Loop::Single(kernel) => motion(kernel, i),
                Loop::Double(kernel) => motion(kernel, i),
            };
            if sync::sane(&self.shapes, i, &motion) {
                sync::advance(&self.shapes, &mut self.state.bodies, i, motion, time);
            } else {
                sync::quarantine(&mut self.state.bodies, &mut self.state.contacts, i);
                report.quarantined.push(i as u32);
            }
        }
    }

    /// Detects again what has moved out of its margin.
    fn detect(&mut self, report: &mut StepReport) {
        let due = due(&self.shapes, &self.state.bodies);
        if !due.is_empty() {
            report.detections += self.state.contacts.detect(&self.shapes, &mut self.state.bodies, &due);
        }
    }

    /// Counts rest, and sleeps where that is allowed.
    fn rest(&mut self) {
        rest::watch(&self.shapes, &mut self.state.bodies, self.params.frame);
        if self.params.sleep && self.state.time > self.params.ramp {
            rest::fall_asleep(&mut self.state.bodies, &self.state.contacts.manifolds);
        }
    }
}
