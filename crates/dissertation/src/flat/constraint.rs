//! The 2-D prototype with rigid bodies (section 3.4.1), after Baraff: collisions at their time, pair by pair, and forces for what rests.
//!
//! While a pair is resolved all other bodies are ignored, so resolving one may put two others inside each other: Figure 3.3. Nothing bounds how
//! often; here a limit does, and the step reports it.

use super::axes;
use super::body::Body;
use super::lcp::LcpError;
use super::manifold;
use super::resting::{self, Touch};
use super::rigid::{Detection, Report, Rigid2D, collide};

/// How near bodies count as touching, m.
const TOUCHING: f64 = 5e-5;

/// Halvings of the time of a step.
const HALVINGS: u32 = 24;

/// How deep a pair is when it collides, as a share of how deep counts as an overlap: what is left keeps rounding from making another collision
/// of a pair that has just stopped.
const SHARE: f64 = 0.9;

/// One step.
pub fn step(world: &mut Rigid2D) -> Report {
    let c = world.constants;
    let mut report = Report::default();
    rest(world, &mut report);
    let start = world.bodies.clone();
    world.fall(c.step);
    // Where each body was at its last collision and when that was, for the way that it goes from there.
    let mut from = Since { start: &start, bodies: start.clone(), time: vec![0.0; start.len()] };
    while let Some((i, j)) = overlapping(world) {
        if report.iterations == c.max_iterations {
            report.capped = true;
            put_back(world, &start);
            break;
        }
        report.iterations += 1;
        resolve(world, i, j, &mut from);
    }
    report
}

/// The first pair that overlaps.
fn overlapping(world: &mut Rigid2D) -> Option<(usize, usize)> {
    let slop = world.constants.slop;
    let pairs = world.pairs();
    pairs
        .into_iter()
        .find(|&(i, j)| world.tester.overlap((i as u32, j as u32), &world.bodies[i], &world.bodies[j], slop))
}

/// What the ways of the bodies through a step begin with.
struct Since<'a> {
    /// All bodies at the start of the step, none of which overlap.
    start: &'a [Body],
    /// Each at its last collision,
    bodies: Vec<Body>,
    /// and when that was, s.
    time: Vec<f64>,
}

/// Takes a pair back to where it began to overlap, lets it collide there, and sends it on for the rest of the step.
fn resolve(world: &mut Rigid2D, i: usize, j: usize, from: &mut Since) {
    let c = world.constants;
    let pair_at = |from: &Since, world: &Rigid2D, time: f64| {
        let at = |k: usize| {
            let Body { velocity, spin, .. } = world.bodies[k];
            Body { velocity, spin, ..from.bodies[k] }.moved(time - from.time[k])
        };
        (at(i), at(j))
    };
    let mut begin = from.time[i].max(from.time[j]);
    let (a, b) = pair_at(from, world, begin);
    if world.tester.overlap((i as u32, j as u32), &a, &b, SHARE * c.slop) {
        // Another pair's collision has put them into each other: they go through the whole step anew.
        for k in [i, j] {
            (from.bodies[k], from.time[k]) = (from.start[k], 0.0);
        }
        begin = 0.0;
    }
    let (start_i, start_j) = pair_at(from, world, begin);
    let (end_i, end_j) = pair_at(from, world, c.step);
    let at = |t: f64| (Body::between(&start_i, &end_i, t), Body::between(&start_j, &end_j, t));
    let ids = (i as u32, j as u32);
    let moving = match c.detection {
        Detection::Bisection => None,
        Detection::MovingAxes => {
            let (way_i, way_j) = (end_i.centre - start_i.centre, end_j.centre - start_j.centre);
            let t = world.tester.first_overlap(&start_i, &start_j, way_i, way_j, SHARE * c.slop);
            // Not to be trusted where they turn: then they are somewhere else at that time.
            t.filter(|&t| {
                let (a, b) = at(t);
                let gap = axes::widest(&a, &b).1;
                (gap + SHARE * c.slop).abs() < 0.5 * (1.0 - SHARE) * c.slop
            })
        }
    };
    let t = moving.unwrap_or_else(|| {
        let (mut apart, mut inside) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (apart + inside);
            let (a, b) = at(middle);
            if world.tester.overlap(ids, &a, &b, SHARE * c.slop) { inside = middle } else { apart = middle }
        }
        apart
    });
    (world.bodies[i], world.bodies[j]) = at(t);
    let points = manifold::points(&world.bodies[i], &world.bodies[j], TOUCHING);
    let touches: Vec<Touch> = points.into_iter().map(|point| Touch { a: i, b: j, point }).collect();
    // The pair's own points against each other, until none approaches.
    for _ in 0..16 {
        for touch in &touches {
            collide(&mut world.bodies, touch, c.restitution, 0.0);
        }
        if touches.iter().all(|t| t.approach(&world.bodies) > -1e-9) {
            break;
        }
    }
    for k in [i, j] {
        from.bodies[k] = world.bodies[k];
        from.time[k] = begin + t * (c.step - begin);
        world.bodies[k] = from.bodies[k].moved(c.step - from.time[k]);
    }
}

/// Puts all bodies that overlap back to where they were, and with them those that then overlap them, until none does.
fn put_back(world: &mut Rigid2D, start: &[Body]) {
    while let Some((i, j)) = overlapping(world) {
        let before = (world.bodies[i], world.bodies[j]);
        (world.bodies[i], world.bodies[j]) = (start[i], start[j]);
        if (world.bodies[i], world.bodies[j]) == before {
            // They overlapped at the start of the step.
            break;
        }
    }
}

/// The contact points at rest, and the forces along their normals, N.
pub fn resting(world: &Rigid2D) -> (Vec<Touch>, Result<Vec<f64>, LcpError>) {
    let c = world.constants;
    let mut touches = world.touches(TOUCHING);
    touches.retain(|t| t.approach(&world.bodies).abs() < c.rest_velocity);
    let forces = resting::forces(&world.bodies, &touches, c.gravity);
    (touches, forces)
}

/// Forces for the points at rest, as impulses over the step.
fn rest(world: &mut Rigid2D, report: &mut Report) {
    let step = world.constants.step;
    let (touches, forces) = resting(world);
    report.resting = touches.len() as u32;
    match forces {
        Ok(forces) => {
            for (touch, force) in touches.iter().zip(forces) {
                touch.push(&mut world.bodies, step * force * touch.point.normal);
            }
        }
        Err(failure) => report.failure = Some(failure),
    }
}
