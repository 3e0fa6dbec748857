//! A frame of a cluster: what is done between two runs of the inner loop, for the bodies that have moved.

use glam::DVec3;

use crate::acts::Acts;
use crate::batch;
use crate::body::FLOOR;
use crate::cluster::{Cluster, with_kernel};
use crate::constants::{SWEEP_LEAST, SYNC_SHARE, SYNC_TIME};
use crate::contacts::{self, Contacts};
use crate::lattice;
use crate::moved::Moved;
use crate::pack::make_room;
use crate::report::HandReport;
use crate::rest;
use crate::setup::Setup;
use crate::sync;
use crate::ways::Ways;

/// A frame to step, the same for all clusters.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub setup: Setup,
    /// Time at its start, s.
    pub start: f64,
    /// Gravity in it, m/s², once it has grown.
    pub gravity: DVec3,
}

impl Frame {
    /// Gravity after so many substeps, m/s²: it grows evenly over the ramp.
    fn gravity(&self, done: usize) -> DVec3 {
        let time = self.start + done as f64 * self.setup.h;
        if time < self.setup.ramp { self.gravity * (time / self.setup.ramp).clamp(0.0, 1.0) } else { self.gravity }
    }

    /// Whether gravity has its full value.
    fn calm(&self) -> bool {
        self.start > self.setup.ramp
    }

    /// The substep before which all that moves is synced next, after `done`.
    fn until(&self, done: usize) -> usize {
        let every = ((SYNC_TIME / self.setup.h).round() as usize).max(1);
        ((done / every + 1) * every).min(self.setup.substeps)
    }
}

/// What came of a frame of one cluster.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    pub substeps: u32,
    pub syncs: u32,
    pub detections: u32,
    /// Deepest overlap, m.
    pub penetration: f64,
    /// Indices in the cluster.
    pub quarantined: Vec<u32>,
    pub hand: Option<HandReport>,
}

impl Cluster {
    /// Makes room for the frame.
    pub fn begin(&mut self, frame: &Frame) {
        self.packing.begin(&self.bodies);
        with_kernel!(self.kernel, |kernel| make_room(kernel, self.bodies.len(), frame.setup.h));
    }

    /// How many substeps to run next; grants each body that has moved how far it may get in them, and wakes what may be touched.
    pub fn grant(&mut self, frame: &Frame, done: usize, moved: &mut Moved, outcome: &mut Outcome) -> usize {
        let speeds = batch::speeds(&self.shapes, &self.bodies, &self.contacts.manifolds);
        let quiet = frame.calm() && speeds.iter().all(|&speed| batch::quiet(speed));
        let end = if quiet { frame.setup.substeps } else { frame.until(done) };
        let time = (end - done) as f64 * frame.setup.h;
        self.grant_reach(moved, &speeds, time);
        let disturbed = rest::disturbed(&self.bodies, &self.contacts.manifolds, &self.packing.reach);
        if !disturbed.is_empty() {
            rest::wake(&mut self.bodies, &self.contacts.manifolds, &disturbed);
            self.sync_others(frame, done, moved, outcome);
            self.grant_reach(moved, &speeds, time);
        }
        end - done
    }

    fn grant_reach(&mut self, moved: &Moved, speeds: &[f64], time: f64) {
        for i in moved.list() {
            self.packing.reach[i] = batch::travel(&self.shapes, &self.bodies, i, speeds[i], time);
        }
        for i in moved.beside.iter().map(|&i| i as usize) {
            self.packing.reach[i] = self.packing.reach[i].min(batch::room(&self.shapes, &self.bodies, i));
        }
    }

    /// Syncs the others as well, so that all is packed anew.
    fn sync_others(&mut self, frame: &Frame, done: usize, moved: &mut Moved, outcome: &mut Outcome) {
        if moved.all {
            return;
        }
        *moved = Moved::all(self.len());
        self.unload(frame, done, moved);
        self.commit(frame, done, moved, outcome);
        self.measure(moved, outcome);
    }

    /// Packs what has moved, for the next `batch` substeps.
    pub fn pack(&mut self, frame: &Frame, acts: &Acts, done: usize, batch: usize, moved: &Moved) {
        let share = (done as f64 + 0.5 * batch as f64) / frame.setup.substeps as f64;
        let gravity = frame.gravity(done);
        let Self { shapes, bodies, particles, contacts, packing, kernel, .. } = self;
        with_kernel!(*kernel, |kernel| {
            packing.load(kernel, contacts, shapes, bodies, &frame.setup, moved);
            for i in moved.list().chain(moved.beside.iter().map(|&i| i as usize)) {
                let (force, torque) = acts.force(bodies, i, share);
                packing.load[i] = (shapes.mass[i] * gravity + force, torque);
                if moved.is[i] {
                    packing.turn[i] = batch::turn(bodies, i, packing.touches(i));
                }
                packing.since[i] = done;
                let lattice = particles.get(i).zip(frame.setup.springs.as_ref());
                packing.load_body(kernel, shapes, bodies, lattice, i, acts.bodies().any(|j| j == i));
            }
        });
    }

    /// Runs the inner loop; returns the substeps done.
    pub fn run(&mut self, frame: &Frame, acts: &mut Acts, done: usize, batch: usize, outcome: &mut Outcome) -> usize {
        outcome.syncs += 1;
        if !self.is_awake() {
            return batch;
        }
        let share = done as f64 / frame.setup.substeps as f64;
        let mut actors = acts.actors(share, frame.setup.frame, frame.gravity(done), &self.shapes, &self.bodies);
        let ran = with_kernel!(self.kernel, |kernel| kernel.run(&frame.setup.law(), batch, &mut actors));
        outcome.substeps += ran as u32;
        outcome.hand = actors.hand.map(|hand| hand.report);
        ran
    }

    /// Who is to be synced after `done` substeps: whoever has used a good part of what was granted; now and then whoever moves at all;
    /// and all at the end and while gravity grows.
    pub fn moved(&mut self, frame: &Frame, acts: &Acts, done: usize) -> Moved {
        let n = self.len();
        if done == frame.setup.substeps || !frame.calm() {
            return Moved::all(n);
        }
        let timely = frame.until(done - 1) == done;
        let mut is = vec![false; n];
        for (i, is) in is.iter_mut().enumerate().filter(|&(i, _)| self.bodies.moves(i)) {
            let (shift, turn) = with_kernel!(self.kernel, |kernel| kernel.displacement(i));
            let (v, w) = with_kernel!(self.kernel, |kernel| kernel.motion(i));
            let travel = shift.length() + turn.length() * self.shapes.radius[i];
            let far = travel > SYNC_SHARE * self.packing.reach[i] || turn.length() > SYNC_SHARE * self.packing.turn[i];
            *is = far || (timely && !batch::quiet(v.length() + w.length() * self.shapes.radius[i]));
        }
        // forces from outside change from batch to batch
        acts.bodies().for_each(|i| is[i] = true);
        Moved::those(is)
    }

    /// Takes the springs of what has moved out of the inner loop, those of a frame without a sync to the last digit of the ways of their
    /// points.
    pub fn unload(&mut self, frame: &Frame, done: usize, moved: &Moved) {
        let Self { contacts, packing, kernel, .. } = self;
        let substeps = frame.setup.substeps;
        let whole = done == substeps && packing.since.iter().all(|&since| since == 0);
        with_kernel!(*kernel, |kernel| {
            let ways = whole.then(|| Ways::of(kernel, substeps));
            packing.unload(kernel, contacts, moved, ways.as_ref());
        });
    }

    /// Makes the displacements of what has moved, and of what touches it, into poses.
    pub fn commit(&mut self, frame: &Frame, done: usize, moved: &mut Moved, outcome: &mut Outcome) {
        if !moved.all {
            for manifold in &self.contacts.manifolds {
                if moved.touches(manifold.a, manifold.b) {
                    moved.add_beside(manifold.a);
                    moved.add_beside(manifold.b);
                }
            }
        }
        for i in moved.list().collect::<Vec<_>>() {
            self.commit_body(frame, done, i, outcome);
        }
        for i in moved.beside.clone() {
            self.commit_body(frame, done, i as usize, outcome);
        }
    }

    /// Makes the displacement of a body into its pose, once.
    fn commit_body(&mut self, frame: &Frame, done: usize, i: usize, outcome: &mut Outcome) {
        if !self.bodies.moves(i) || self.packing.since[i] == done {
            return;
        }
        let time = (done - self.packing.since[i]) as f64 * frame.setup.h;
        let mut taken = with_kernel!(self.kernel, |kernel| kernel.taken(i));
        let flies = self.packing.free[i];
        if flies {
            sync::fly(&self.shapes, &self.bodies, i, self.packing.load[i].0, time, &mut taken);
        }
        self.packing.since[i] = done;
        if !sync::sane(&self.shapes, i, &taken) {
            sync::quarantine(&mut self.bodies, &mut self.contacts, i);
            outcome.quarantined.push(i as u32);
            return;
        }
        self.packing.reach[i] -= taken.shift.length() + taken.turn.length() * self.shapes.radius[i];
        self.packing.turn[i] -= taken.turn.length();
        match (&taken.particles, self.particles.get_mut(i)) {
            (Some(moved), Some(particles)) => {
                let flight = flies.then_some((taken.shift, taken.velocity));
                lattice::advance(&self.shapes, &mut self.bodies, i, particles, moved, flight, time);
            }
            _ => sync::advance(&self.shapes, &mut self.bodies, i, &taken, time),
        }
    }

    /// Detects again what has moved out of its margin.
    pub fn detect(&mut self, frame: &Frame, done: usize, moved: &mut Moved, outcome: &mut Outcome) {
        let due: Vec<u32> =
            moved.list().filter(|&i| contacts::due(&self.shapes, &self.bodies, i)).map(|i| i as u32).collect();
        if due.is_empty() {
            return;
        }
        let left = (frame.setup.substeps - done) as f64 * frame.setup.h;
        let reach = SWEEP_LEAST + 2.0 * self.speed() * left;
        let (pairs, outgrown) = self.contacts.candidates(&self.shapes, &mut self.bodies, &due, reach);
        self.outgrown |= outgrown;
        let before = moved.beside.len();
        if !moved.all {
            for &(low, high) in &pairs {
                moved.add_beside(if low == FLOOR { high } else { low });
                moved.add_beside(high);
            }
        }
        for i in moved.beside[before..].iter().copied() {
            self.commit_body(frame, done, i as usize, outcome);
        }
        self.contacts.detect(&self.shapes, &mut self.bodies, &due, &pairs);
        outcome.detections += pairs.len() as u32;
    }

    /// Makes the gaps of what has moved exact again.
    pub fn measure(&mut self, moved: &Moved, outcome: &mut Outcome) {
        for manifold in &mut self.contacts.manifolds {
            if moved.touches(manifold.a, manifold.b) {
                outcome.penetration = outcome.penetration.max(Contacts::measure(&self.bodies, manifold));
            }
        }
    }

    /// Counts rest, and sleeps where that is allowed.
    pub fn rest(&mut self, frame: &Frame) {
        rest::watch(&self.shapes, &mut self.bodies, frame.setup.frame);
        if frame.setup.sleep && frame.start + frame.setup.frame > frame.setup.ramp {
            rest::fall_asleep(&mut self.bodies, &self.contacts.manifolds);
            lattice::halt(&self.bodies, &mut self.particles);
        }
    }
}
