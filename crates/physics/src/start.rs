//! Start of a world: what touches carries its weight from the first instant.
//!
//! Full gravity at once would drop a tower onto its springs and rock what is nearly balanced. So a
//! new world settles before its time begins: gravity grows while motion is damped, until the blocks
//! of each island that bears on the floor or a fixed block have compressed their contacts. From
//! then on bodies stop whenever the kinetic energy of their island has passed a peak (dynamic
//! relaxation with kinetic damping), which ends slow sway as soon as quick vibration. What is in
//! the air waits. An island that does not come to rest, because it falls or slides, begins in the
//! poses of the scene.

use glam::DVec3;

use crate::body::{FLOOR, middle_edge};
use crate::body_id::BodyId;
use crate::cluster::island::islands;
use crate::collision::manifold::{ContactPoint, Manifold};
use crate::constants::{START_DAMPING, START_RAMP, START_REACH, START_SPEED, START_TIME, SWAY_SPEED, TOUCH_GAP};
use crate::input::Input;
use crate::pose::Twist;
use crate::world::World;

/// State of an island of a new world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Island {
    /// In the air.
    Free,
    /// Bears on the floor or a fixed block, and settles.
    Settling,
    /// Has come to rest.
    Settled,
    /// Falls or slides.
    Restless,
}

/// Islands of a new world.
struct Islands {
    /// Island of each body: the lowest index of a body in it.
    root: Vec<u32>,
    /// State of each island, at the index of its lowest body.
    states: Vec<Island>,
    /// Largest kinetic energy of each island since its bodies were last stopped, J.
    peaks: Vec<f64>,
}

impl Islands {
    fn of(&self, body: BodyId) -> Island {
        self.states[self.root[body.index()] as usize]
    }

    fn set(&mut self, body: BodyId, state: Island) {
        self.states[self.root[body.index()] as usize] = state;
    }

    fn are_settling(&self) -> bool {
        self.states.contains(&Island::Settling)
    }
}

impl World {
    /// Compresses the contacts of all that touches; the time stays zero.
    pub(crate) fn settle_start(&mut self) {
        let mut islands = self.start_islands();
        if !islands.are_settling() {
            return;
        }
        let initial = self.clone();
        for body in self.bodies() {
            self.set_twist(body, Twist { velocity: DVec3::ZERO, spin: DVec3::ZERO });
            if islands.of(body) != Island::Settling {
                self.hold(body);
            }
        }
        (self.derived.ramp, self.derived.sleep) = (START_RAMP, false);
        while self.time < START_TIME && islands.are_settling() {
            self.step(&Input::default());
            self.judge_islands(&initial, &mut islands);
            self.relax(&mut islands);
        }
        self.begin(&initial, |body| islands.of(body) == Island::Settled);
    }

    /// Takes motion from the islands that settle: a share of it while gravity grows, then all of it
    /// when the kinetic energy of the island has passed a peak.
    fn relax(&mut self, islands: &mut Islands) {
        let mut energies = vec![0.0f64; self.len()];
        for body in self.bodies() {
            let (cluster, i) = self.clusters.get(body.0);
            energies[islands.root[body.index()] as usize] += cluster.bodies.kinetic_energy(&cluster.shapes, i);
        }
        let grows = self.time < START_RAMP;
        for body in self.bodies() {
            let root = islands.root[body.index()] as usize;
            let share = match energies[root] < islands.peaks[root] {
                _ if grows => START_DAMPING,
                true => 0.0,
                false => 1.0,
            };
            match islands.of(body) {
                Island::Settling => self.slow(body, share),
                Island::Free | Island::Settled | Island::Restless => self.hold(body),
            }
        }
        for (peak, energy) in islands.peaks.iter_mut().zip(energies) {
            *peak = if grows || energy < *peak { 0.0 } else { energy };
        }
    }

    /// Updates the states of the islands that settle.
    fn judge_islands(&self, initial: &Self, islands: &mut Islands) {
        self.find_restless(initial, islands);
        let mut speed = vec![0.0f64; self.len()];
        for body in self.bodies() {
            let (cluster, i) = self.clusters.get(body.0);
            let root = islands.root[body.index()] as usize;
            speed[root] = speed[root].max(cluster.bodies.max_point_speed(&cluster.shapes, i));
        }
        let last = self.time + self.derived.frame > START_TIME;
        // A tall tower still sways a little at the end; what falls is a hundred times as fast.
        let enough = if last { SWAY_SPEED } else { START_SPEED };
        for (state, speed) in islands.states.iter_mut().zip(speed).filter(|(state, _)| **state == Island::Settling) {
            if speed < enough && self.time > START_RAMP {
                *state = Island::Settled;
            } else if last {
                *state = Island::Restless;
            }
        }
    }

    /// Finds islands of which a body has moved against one that it touched. A tower may sink by
    /// more as a whole.
    fn find_restless(&self, initial: &Self, islands: &mut Islands) {
        let moved = |body: BodyId| self.pose(body).position - initial.pose(body).position;
        let middle = |body: BodyId| middle_edge(0.5 * self.size(body));
        for cluster in &initial.clusters.list {
            let body = |i: u32| (i != FLOOR).then(|| BodyId(cluster.ids[i as usize]));
            for manifold in cluster.contacts.manifolds.iter().filter(|m| touches(m)) {
                let Some(b) = body(manifold.b) else { continue };
                let against = body(manifold.a).map_or(DVec3::ZERO, moved);
                let reach = body(manifold.a).map_or(f64::INFINITY, middle).min(middle(b));
                if (moved(b) - against).length() > START_REACH * reach {
                    for body in [Some(b), body(manifold.a)].into_iter().flatten() {
                        if islands.of(body) == Island::Settling {
                            islands.set(body, Island::Restless);
                        }
                    }
                }
            }
        }
    }

    /// Islands at the start: those that bear on something settle.
    fn start_islands(&self) -> Islands {
        let mut pairs = Vec::new();
        let mut borne = vec![false; self.len()];
        for cluster in &self.clusters.list {
            let held = |i: u32| i == FLOOR || cluster.bodies.fixed[i as usize];
            for manifold in cluster.contacts.manifolds.iter().filter(|m| touches(m)) {
                match (held(manifold.a), held(manifold.b)) {
                    (false, false) => pairs.push((cluster.ids[manifold.a as usize], cluster.ids[manifold.b as usize])),
                    (true, false) => borne[cluster.ids[manifold.b as usize] as usize] = true,
                    (false, true) => borne[cluster.ids[manifold.a as usize] as usize] = true,
                    (true, true) => {}
                }
            }
        }
        let root = islands(self.len(), pairs.into_iter());
        let mut states = vec![Island::Free; self.len()];
        for (&root, borne) in root.iter().zip(borne) {
            if borne {
                states[root as usize] = Island::Settling;
            }
        }
        let peaks = vec![0.0; self.len()];
        Islands { root, states, peaks }
    }

    /// Ends the settling: time begins, with the bodies in their settled poses where `settled`, else
    /// in those of `initial`, and with its velocities.
    fn begin(&mut self, initial: &Self, settled: impl Fn(BodyId) -> bool) {
        (self.derived, self.time, self.gravity) = (initial.derived, 0.0, initial.gravity);
        for body in self.bodies() {
            let (from, i) = initial.clusters.get(body.0);
            let (to, j) = self.clusters.get_mut(body.0);
            to.bodies.fixed[j] = from.bodies.fixed[i];
            to.bodies.quarantined[j] = false;
            to.bodies.asleep[j] = false;
            if !settled(body) {
                to.bodies.position[j] = from.bodies.position[i];
                to.bodies.orientation[j] = from.bodies.orientation[i];
                if let Some(particles) = to.particles.get_mut(j) {
                    *particles = from.particles[i];
                    to.bodies.stretch[j] = from.bodies.stretch[i];
                }
            }
            to.bodies.acceleration[j] = 0.0;
            to.bodies.rest_time[j] = 0.0;
            to.bodies.rest_pose[j] = (to.bodies.position[j], to.bodies.orientation[j]);
            self.set_twist(body, initial.twist(body));
        }
        for cluster in &mut self.clusters.list {
            let moved_back = |i: u32| i != FLOOR && !settled(BodyId(cluster.ids[i as usize]));
            let stale = |m: &&mut Manifold| moved_back(m.a) || moved_back(m.b);
            cluster
                .contacts
                .manifolds
                .iter_mut()
                .filter(stale)
                .for_each(|m| m.points.iter_mut().for_each(ContactPoint::reset));
            cluster.contacts.detect_initial(&cluster.shapes, &mut cluster.bodies);
            cluster.contacts.outgrown = true;
        }
        self.write_poses();
    }

    /// Holds a body in place.
    fn hold(&mut self, body: BodyId) {
        let (cluster, i) = self.clusters.get_mut(body.0);
        cluster.bodies.fixed[i] = true;
        cluster.bodies.velocity[i] = DVec3::ZERO;
        cluster.bodies.spin[i] = DVec3::ZERO;
    }

    /// Leaves a share of a body's motion as a whole; particles of a block lose that of their
    /// strain.
    fn slow(&mut self, body: BodyId, share: f64) {
        let Twist { velocity, spin } = self.twist(body);
        self.set_twist(body, Twist { velocity: velocity * share, spin: spin * share });
    }
}

/// Returns true if two bodies touch at the start.
fn touches(manifold: &Manifold) -> bool {
    manifold.points.iter().any(|p| p.gap < TOUCH_GAP)
}
