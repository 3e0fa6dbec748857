//! Two-dimensional prototype with rigid bodies (section 3.4.1), after Baraff: collisions pair by
//! pair at their time, and forces for resting contact.
//!
//! While a pair is resolved all other bodies are ignored, so resolving one may make two others
//! overlap (Figure 3.3). Nothing bounds the number of iterations but a limit, which the step
//! reports.

use super::axes;
use super::body::Body;
use super::lcp::LcpError;
use super::manifold;
use super::resting::{self, Contact};
use super::rigid::{Detection, Report, Rigid2D};

/// Maximum separation of bodies in contact, m.
const CONTACT_MARGIN: f64 = 5e-5;

/// Number of bisections of the time of a step.
const BISECTIONS: u32 = 24;

/// Maximum number of rounds over the contact points of a colliding pair.
const ROUNDS: u32 = 16;

/// Penetration of a pair at its collision, over that of an overlap. The difference keeps rounding
/// from starting another collision of a pair that has just stopped.
const COLLISION_RATIO: f64 = 0.9;

/// Advances by one step.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    let mut report = Report::default();
    apply_resting_forces(world, &mut report);
    let start = world.bodies.clone();
    world.integrate(c.step);
    let mut segments = Segments { start: &start, bodies: start.clone(), times: vec![0.0; start.len()] };
    while let Some(pair) = first_overlap(world) {
        if report.iterations == c.max_iterations {
            report.capped = true;
            reset_overlapping(world, &start);
            break;
        }
        report.iterations += 1;
        resolve(world, pair, &mut segments);
    }
    report
}

/// Returns the first pair of bodies that overlaps.
fn first_overlap(world: &mut Rigid2D) -> Option<[usize; 2]> {
    let slop = world.constants.slop;
    let pairs = world.pairs();
    pairs.into_iter().map(|(i, j)| [i, j]).find(|&[i, j]| {
        let (a, b) = (world.bodies[i], world.bodies[j]);
        world.tester.overlap((i as u32, j as u32), &a, &b, slop)
    })
}

/// Starts of the path segments of the bodies: their last collisions in the step.
struct Segments<'a> {
    /// Bodies at the start of the step, without overlap.
    start: &'a [Body],
    /// Bodies at the starts of their segments.
    bodies: Vec<Body>,
    /// Times of the starts, s.
    times: Vec<f64>,
}

impl Segments<'_> {
    /// Returns a pair of bodies at a time (s) of the step.
    fn pair_at(&self, world: &Rigid2D, pair: [usize; 2], time: f64) -> [Body; 2] {
        pair.map(|k| {
            let Body { velocity, spin, .. } = world.bodies[k];
            Body { velocity, spin, ..self.bodies[k] }.advanced(time - self.times[k])
        })
    }

    /// Returns the latest time (s) from which both segments of a pair are known and start without
    /// overlap.
    ///
    /// Where the collision of another pair has made the two overlap, they restart at the start of
    /// the step.
    fn begin(&mut self, world: &mut Rigid2D, pair: [usize; 2]) -> f64 {
        let [i, j] = pair;
        let begin = self.times[i].max(self.times[j]);
        let [a, b] = self.pair_at(world, pair, begin);
        let slop = COLLISION_RATIO * world.constants.slop;
        if !world.tester.overlap((i as u32, j as u32), &a, &b, slop) {
            return begin;
        }
        for k in pair {
            (self.bodies[k], self.times[k]) = (self.start[k], 0.0);
        }
        0.0
    }
}

/// Paths of a pair of bodies while t goes from 0 to 1.
struct PairPath {
    start: [Body; 2],
    end: [Body; 2],
}

impl PairPath {
    fn at(&self, t: f64) -> [Body; 2] {
        [0, 1].map(|k| Body::interpolate(&self.start[k], &self.end[k], t))
    }
}

/// Moves a pair back to the start of its overlap, applies the collision there, and advances it to
/// the end of the step.
fn resolve(world: &mut Rigid2D, pair: [usize; 2], segments: &mut Segments) {
    let step = world.constants.step;
    let begin = segments.begin(world, pair);
    let path = PairPath { start: segments.pair_at(world, pair, begin), end: segments.pair_at(world, pair, step) };
    let t = collision_time(world, pair, &path);
    let [i, j] = pair;
    [world.bodies[i], world.bodies[j]] = path.at(t);
    collide_pair(world, pair);
    for k in pair {
        segments.bodies[k] = world.bodies[k];
        segments.times[k] = begin + t * (step - begin);
        world.bodies[k] = segments.bodies[k].advanced(step - segments.times[k]);
    }
}

/// Returns the time from 0 to 1 at which a pair collides on its paths.
fn collision_time(world: &mut Rigid2D, [i, j]: [usize; 2], path: &PairPath) -> f64 {
    let c = world.constants;
    let slop = COLLISION_RATIO * c.slop;
    if c.detection == Detection::MovingAxes {
        let [a, b] = [0, 1].map(|k| path.end[k].centre - path.start[k].centre);
        let [start_a, start_b] = &path.start;
        let t = world.tester.first_overlap(start_a, start_b, b - a, slop);
        // Bodies that rotate are elsewhere at that time, and need bisection.
        let exact = t.filter(|&t| {
            let [a, b] = path.at(t);
            let separation = axes::max_separation(&a, &b).1;
            (separation + slop).abs() < 0.5 * (1.0 - COLLISION_RATIO) * c.slop
        });
        if let Some(t) = exact {
            return t;
        }
    }
    let (mut apart, mut inside) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (apart + inside);
        let [a, b] = path.at(middle);
        if world.tester.overlap((i as u32, j as u32), &a, &b, slop) { inside = middle } else { apart = middle }
    }
    apart
}

/// Applies the impulses of a pair's contact points until none approaches.
fn collide_pair(world: &mut Rigid2D, [a, b]: [usize; 2]) {
    let points = manifold::points(&world.bodies[a], &world.bodies[b], CONTACT_MARGIN);
    let contacts: Vec<Contact> = points.into_iter().map(|point| Contact { a, b, point }).collect();
    for _ in 0..ROUNDS {
        for contact in &contacts {
            contact.collide(&mut world.bodies, world.constants.restitution, 0.0);
        }
        if contacts.iter().all(|contact| contact.approach_velocity(&world.bodies) > -1e-9) {
            break;
        }
    }
}

/// Resets overlapping bodies to the start of the step, until none overlaps.
fn reset_overlapping(world: &mut Rigid2D, start: &[Body]) {
    while let Some([i, j]) = first_overlap(world) {
        let before = (world.bodies[i], world.bodies[j]);
        (world.bodies[i], world.bodies[j]) = (start[i], start[j]);
        if (world.bodies[i], world.bodies[j]) == before {
            // The two overlapped at the start of the step.
            break;
        }
    }
}

/// Returns the resting contact points and their normal forces, N.
pub fn resting(world: &Rigid2D) -> (Vec<Contact>, Result<Vec<f64>, LcpError>) {
    let c = world.constants;
    let mut contacts = world.contacts(CONTACT_MARGIN);
    contacts.retain(|contact| contact.approach_velocity(&world.bodies).abs() < c.rest_velocity);
    let forces = resting::forces(&world.bodies, &contacts, c.gravity);
    (contacts, forces)
}

/// Applies the forces of the resting contact points as impulses over the step.
fn apply_resting_forces(world: &mut Rigid2D, report: &mut Report) {
    let step = world.constants.step;
    let (contacts, forces) = resting(world);
    report.resting = contacts.len() as u32;
    match forces {
        Ok(forces) => {
            for (contact, force) in contacts.iter().zip(forces) {
                contact.apply_impulse(&mut world.bodies, step * force * contact.point.normal);
            }
        }
        Err(error) => report.failure = Some(error),
    }
}
