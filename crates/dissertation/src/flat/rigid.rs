//! World of rigid rectangles with a choice of contact method: constraints, the two-dimensional
//! prototype of section 3.4.1, and the penalty method and micro-collisions of chapter 2.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::axes::Tester;
use super::body::Body;
use super::lcp::LcpError;
use super::manifold;
use super::resting::Contact;
use super::scene::Rectangle;

/// Contact method.
///
/// ```
/// use teeter_dissertation::flat::Method;
///
/// assert_eq!(Method::ALL.map(Method::name), ["constraints", "penalty", "micro-collisions"]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Impulses for colliding contact, resolved pair by pair at the time of collision, and forces
    /// by Dantzig's algorithm for resting contact.
    Constraint,
    /// Force proportional to the penetration (Eq. 2.12).
    Penalty,
    /// Impulses only, with resting contact as very small collisions.
    MicroCollisions,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 3] = [Method::Constraint, Method::Penalty, Method::MicroCollisions];

    /// Name of the method.
    pub fn name(self) -> &'static str {
        match self {
            Method::Constraint => "constraints",
            Method::Penalty => "penalty",
            Method::MicroCollisions => "micro-collisions",
        }
    }
}

/// Search for the time of a collision.
///
/// ```
/// use teeter_dissertation::flat::{Detection, Method, rigid::Constants};
///
/// assert_eq!(Constants::of(Method::Constraint).detection, Detection::Bisection);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Detection {
    /// Bisection between a time without overlap and one with overlap (Figure 2.4).
    Bisection,
    /// Separating axes of moving bodies that do not rotate, and bisection where they rotate into
    /// each other.
    MovingAxes,
}

/// Constants of a world. Lengths in m, masses in kg, times in s.
///
/// ```
/// use teeter_dissertation::flat::{Method, rigid::Constants};
///
/// assert_eq!(Constants::of(Method::Penalty).step, 1.0 / 9600.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Contact method.
    pub method: Method,
    /// Search for the time of a collision.
    pub detection: Detection,
    /// True to cache separating axes from step to step.
    pub witnesses: bool,
    /// Time of a step, s.
    pub step: f64,
    /// Acceleration of gravity along -y, m/s².
    pub gravity: f64,
    /// Ratio of the speeds after and before a collision.
    pub restitution: f64,
    /// Coefficient of friction; the constraint method has none.
    pub friction: f64,
    /// Maximum penetration without a collision, m.
    pub slop: f64,
    /// Maximum relative velocity of a resting contact, m/s.
    pub rest_velocity: f64,
    /// Maximum number of pairs that one step resolves. A step that reaches it resets the remaining
    /// bodies and reports it.
    pub max_iterations: u32,
    /// Stiffness of the penalty method, N/m (Eq. 2.12).
    pub stiffness: f64,
    /// Damping of the penalty method, N s/m.
    pub damping: f64,
}

impl Constants {
    /// Default constants of a method.
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

/// Report of one step.
///
/// ```
/// use teeter_dissertation::flat::scene::stack;
/// use teeter_dissertation::flat::{Method, Rigid2D, rigid::Constants};
///
/// let mut world = Rigid2D::new(&stack(2, 0.0), Constants::of(Method::Constraint));
/// let report = world.step();
/// assert_eq!((report.iterations, report.resting), (0, 4));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Report {
    /// Number of pairs resolved, or of impulses.
    pub iterations: u32,
    /// True when the limit was reached.
    pub capped: bool,
    /// Number of resting contact points.
    pub resting: u32,
    /// Error of solving for their forces.
    pub failure: Option<LcpError>,
}

/// Rigid rectangles on a floor.
///
/// ```
/// use teeter_dissertation::flat::scene::stack;
/// use teeter_dissertation::flat::{Method, Rigid2D, rigid::Constants};
///
/// let mut world = Rigid2D::new(&stack(3, 0.0), Constants::of(Method::Constraint));
/// for _ in 0..240 {
///     world.step();
/// }
/// assert!((world.pose(2).0.y - 0.045).abs() < 1e-5);
/// ```
#[derive(Debug, Clone)]
pub struct Rigid2D {
    /// Constants.
    pub constants: Constants,
    /// Bodies: the floor, then the blocks.
    pub bodies: Vec<Body>,
    /// Overlap test with its counters.
    pub tester: Tester,
}

impl Rigid2D {
    /// Creates blocks at rest.
    pub fn new(blocks: &[Rectangle], constants: Constants) -> Self {
        let bodies = std::iter::once(Body::floor()).chain(blocks.iter().map(Body::new)).collect();
        Self { constants, bodies, tester: Tester::new(constants.witnesses) }
    }

    /// Adds a block at rest.
    pub fn add(&mut self, block: &Rectangle) {
        self.bodies.push(Body::new(block));
    }

    /// Position of the centre (m) and rotation (rad) of a block.
    pub fn pose(&self, block: usize) -> (DVec2, f64) {
        let body = &self.bodies[block + 1];
        (body.centre, body.angle)
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.bodies.len() - 1
    }

    /// Returns true if there is no block.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Pairs of bodies whose bounding circles overlap.
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

    /// Returns the contact points at most `margin` (m) apart.
    pub fn contacts(&self, margin: f64) -> Vec<Contact> {
        let of = |(i, j): (usize, usize)| {
            manifold::points(&self.bodies[i], &self.bodies[j], margin).into_iter().map(move |point| Contact {
                a: i,
                b: j,
                point,
            })
        };
        self.pairs().into_iter().flat_map(of).collect()
    }

    /// Integrates gravity, then the poses, over a time (s).
    pub(super) fn integrate(&mut self, time: f64) {
        for body in self.bodies.iter_mut().filter(|b| b.inverse_mass > 0.0) {
            body.velocity.y -= self.constants.gravity * time;
            *body = body.advanced(time);
        }
    }
}
