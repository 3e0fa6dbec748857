//! Rigid rectangles with a choice of what to do at contacts: the 2-D prototype (section 3.4.1) by constraints, and beside it the penalty method
//! and micro-collisions of chapter 2.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::axes::Tester;
use super::body::Body;
use super::lcp::LcpError;
use super::resting::Touch;
use super::scene::Rectangle;
use super::{constraint, micro, penalty};

/// What is done at contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Impulses for colliding contact, resolved pair by pair at the time of collision; forces by Dantzig's algorithm for resting contact.
    Constraint,
    /// A force in proportion to the depth (Eq. 2.12).
    Penalty,
    /// Impulses for everything, resting contact as very small collisions.
    MicroCollisions,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 3] = [Method::Constraint, Method::Penalty, Method::MicroCollisions];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Method::Constraint => "constraints",
            Method::Penalty => "penalty",
            Method::MicroCollisions => "micro-collisions",
        }
    }
}

/// How the time of a collision is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Detection {
    /// By halves between a time apart and one overlapping (Figure 2.4).
    Bisection,
    /// By the separating axes of moving bodies, which do not turn; by halves where they turn into each other.
    MovingAxes,
}

/// Constants. Lengths in m, masses in kg, times in s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// What is done at contacts.
    pub method: Method,
    /// How the time of a collision is found.
    pub detection: Detection,
    /// Whether separating axes are kept from step to step.
    pub witnesses: bool,
    /// Time of a step, s.
    pub step: f64,
    /// Acceleration of gravity along -y, m/s².
    pub gravity: f64,
    /// Ratio of the speeds after and before a collision.
    pub restitution: f64,
    /// Coefficient of friction; the constraint method has none.
    pub friction: f64,
    /// How deep bodies may be inside each other without a collision, m.
    pub slop: f64,
    /// Relative velocity below which a contact is at rest, m/s.
    pub rest_velocity: f64,
    /// Most pairs that one step resolves: what would go on for ever is cut short there, its bodies are put back, and the step says so.
    pub max_iterations: u32,
    /// Force per depth, N/m (Eq. 2.12).
    pub stiffness: f64,
    /// Force per velocity into each other, N s/m.
    pub damping: f64,
}

impl Constants {
    /// What suits a method.
    pub fn of(method: Method) -> Self {
        Self {
            method,
            detection: Detection::Bisection,
            witnesses: true,
            step: match method {
                Method::Constraint => 1.0 / 240.0,
                Method::Penalty => 1.0 / 9600.0,
                Method::MicroCollisions => 1.0 / 1920.0,
            },
            gravity: 9.81,
            restitution: 0.3,
            friction: 0.4,
            slop: 1e-5,
            rest_velocity: 0.01,
            max_iterations: 1000,
            stiffness: 2e4,
            damping: 10.0,
        }
    }
}

/// What one step did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Report {
    /// Pairs that were resolved one after the other.
    pub iterations: u32,
    /// Whether the limit was reached and the bodies left over put back.
    pub capped: bool,
    /// Contact points at rest whose forces were solved for.
    pub resting: u32,
    /// Why there are no forces for them.
    pub failure: Option<LcpError>,
}

/// Rigid rectangles over a floor.
#[derive(Debug, Clone)]
pub struct Rigid2D {
    /// The constants.
    pub constants: Constants,
    /// The floor, then the blocks.
    pub bodies: Vec<Body>,
    /// The test of overlap and its counters.
    pub tester: Tester,
}

impl Rigid2D {
    /// Blocks at rest.
    pub fn new(blocks: &[Rectangle], constants: Constants) -> Self {
        let bodies = std::iter::once(Body::floor()).chain(blocks.iter().map(Body::new)).collect();
        Self { constants, bodies, tester: Tester::new(constants.witnesses) }
    }

    /// One more block, at rest.
    pub fn add(&mut self, block: &Rectangle) {
        self.bodies.push(Body::new(block));
    }

    /// One step.
    pub fn step(&mut self) -> Report {
        match self.constants.method {
            Method::Constraint => constraint::step(self),
            Method::Penalty => penalty::step(self),
            Method::MicroCollisions => micro::step(self),
        }
    }

    /// Centre (m) and turn (rad) of a block.
    pub fn pose(&self, block: usize) -> (DVec2, f64) {
        let body = &self.bodies[block + 1];
        (body.centre, body.angle)
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.bodies.len() - 1
    }

    /// Whether there is no block.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Pairs of bodies that may touch: their circles do.
    pub(super) fn pairs(&self) -> Vec<(usize, usize)> {
        let near = |i: usize, j: usize| {
            let (a, b) = (&self.bodies[i], &self.bodies[j]);
            i == 0 && b.centre.y < b.half.length() + 1e-3
                || i > 0 && a.centre.distance(b.centre) < a.half.length() + b.half.length() + 1e-3
        };
        (0..self.bodies.len())
            .flat_map(|i| (i + 1..self.bodies.len()).map(move |j| (i, j)))
            .filter(|&(i, j)| near(i, j))
            .collect()
    }

    /// Contact points no more than `margin` (m) apart.
    pub fn touches(&self, margin: f64) -> Vec<Touch> {
        let of = |(i, j): (usize, usize)| {
            super::manifold::points(&self.bodies[i], &self.bodies[j], margin).into_iter().map(move |point| Touch {
                a: i,
                b: j,
                point,
            })
        };
        self.pairs().into_iter().flat_map(of).collect()
    }

    /// Gravity over a time, and then the way.
    pub(super) fn fall(&mut self, time: f64) {
        for body in self.bodies.iter_mut().filter(|b| b.inverse_mass > 0.0) {
            body.velocity.y -= self.constants.gravity * time;
            *body = body.moved(time);
        }
    }
}

/// An impulse that turns an approach at a contact round by the coefficient of restitution (Eq. 2.10 with 1 + e, see `jenga3d::response`), and
/// Coulomb's friction within it.
pub(super) fn collide(bodies: &mut [Body], touch: &Touch, restitution: f64, friction: f64) {
    let approach = touch.approach(bodies);
    if approach >= 0.0 {
        return;
    }
    let n = touch.point.normal;
    let j = -(1.0 + restitution) * approach / touch.inverse_mass(bodies, n); // Eq. 2.10
    let t = n.perp();
    let sliding =
        (bodies[touch.a].velocity_at(touch.point.place) - bodies[touch.b].velocity_at(touch.point.place)).dot(t);
    let across = -sliding / touch.inverse_mass(bodies, t);
    touch.push(bodies, j * n + across.clamp(-friction * j, friction * j) * t);
}
