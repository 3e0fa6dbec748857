//! Two-dimensional prototype with springs (section 3.4.2): four particles, six springs and four
//! edges a block.

use glam::DVec2;

use super::scene::Rectangle;
use crate::jenga3d::cubic::Cubic;

/// Constants of the prototype. Lengths in m, masses in kg, times in s.
///
/// ```
/// let constants = teeter_dissertation::flat::springs::Constants::default();
/// assert_eq!((constants.iterations, constants.stiffness), (5, 2e4));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Time of a step, s.
    pub step: f64,
    /// Acceleration of gravity along -y, m/s².
    pub gravity: f64,
    /// Stiffness of every spring, N/m.
    pub stiffness: f64,
    /// Damping of every spring, N s/m.
    pub damping: f64,
    /// Number of steps of Euler's method within one step, five in the text.
    pub iterations: u32,
    /// Ratio of the speeds after and before a collision.
    pub restitution: f64,
    /// Coefficient of friction in a collision.
    pub friction: f64,
    /// Maximum number of rounds over the pairs in a step.
    pub max_sweeps: u32,
}

impl Default for Constants {
    fn default() -> Self {
        Self {
            step: 2.5e-4,
            gravity: 9.81,
            stiffness: 2e4,
            damping: 4.0,
            iterations: 5,
            restitution: 0.1,
            friction: 0.4,
            max_sweeps: 20,
        }
    }
}

/// State of a particle.
///
/// ```
/// use teeter_dissertation::flat::springs::State;
///
/// assert_eq!(State::default().velocity, glam::DVec2::ZERO);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct State {
    /// Position, m.
    pub position: DVec2,
    /// Velocity, m/s.
    pub velocity: DVec2,
}

/// Corners at the ends of each spring: the four edges, counter-clockwise with the block on their
/// left, and the two diagonals.
const SPRINGS: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];
/// Number of springs that are edges.
const EDGES: usize = 4;

/// Blocks of springs in the plane.
///
/// ```
/// use teeter_dissertation::flat::scene::stack;
/// use teeter_dissertation::flat::{Springs2D, springs};
///
/// let mut world = Springs2D::new(&stack(2, 1e-3), springs::Constants::default());
/// for _ in 0..400 {
///     assert!(!world.step().unresolved);
/// }
/// assert!((world.pose(1).0.y - 0.027).abs() < 1e-3);
/// ```
#[derive(Debug, Clone)]
pub struct Springs2D {
    /// Constants.
    pub constants: Constants,
    /// Last valid states, four a block.
    pub curr: Vec<State>,
    next: Vec<State>,
    /// Mass of a particle of each block, kg.
    masses: Vec<f64>,
    /// Rest lengths of the springs of each block, m.
    rest: Vec<[f64; 6]>,
}

/// Weights of the four corners in a point given as fractions of the edges.
fn weights(at: DVec2) -> [f64; 4] {
    let (x, y) = (at.x, at.y);
    [(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y]
}

/// Report of one step.
///
/// ```
/// use teeter_dissertation::flat::springs::Report;
///
/// assert_eq!(Report::default().collisions, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Report {
    /// Number of rounds over the pairs; the last finds nothing unless the limit is reached.
    pub sweeps: u32,
    /// Number of collisions resolved.
    pub collisions: u32,
    /// True when collisions are left.
    pub unresolved: bool,
}

impl Springs2D {
    /// Creates blocks at rest.
    pub fn new(blocks: &[Rectangle], constants: Constants) -> Self {
        let mut world = Self { constants, curr: Vec::new(), next: Vec::new(), masses: Vec::new(), rest: Vec::new() };
        for block in blocks {
            world.add(block);
        }
        world
    }

    /// Adds a block at rest.
    pub fn add(&mut self, block: &Rectangle) {
        let corners = [DVec2::new(-0.5, -0.5), DVec2::new(0.5, -0.5), DVec2::new(0.5, 0.5), DVec2::new(-0.5, 0.5)];
        let states = corners.map(|c| State { position: block.centre + c * block.size, velocity: DVec2::ZERO });
        self.rest.push(SPRINGS.map(|[a, b]| states[a].position.distance(states[b].position)));
        self.masses.push(block.mass / 4.0);
        self.curr.extend(states);
        self.next.extend(states);
    }

    /// Position and velocity of a point of a block, given as fractions of its edges from the lower
    /// left corner.
    pub fn point(&self, block: usize, at: DVec2) -> State {
        let mut point = State::default();
        for (state, w) in self.curr[4 * block..][..4].iter().zip(weights(at)) {
            point.position += w * state.position;
            point.velocity += w * state.velocity;
        }
        point
    }

    /// Applies an impulse (N s) at a point of a block, given as fractions of its edges, weighted
    /// over its particles.
    pub fn apply_impulse(&mut self, block: usize, at: DVec2, impulse: DVec2) {
        let mass = self.masses[block];
        for (state, w) in self.curr[4 * block..][..4].iter_mut().zip(weights(at)) {
            state.velocity += impulse * (w / mass);
        }
    }

    /// Position of the centre of a block, m, and its rotation, rad: the direction of its lower
    /// edge.
    pub fn pose(&self, block: usize) -> (DVec2, f64) {
        let p = &self.curr[4 * block..][..4];
        let along = p[1].position + p[2].position - p[0].position - p[3].position;
        (p.iter().map(|s| s.position).sum::<DVec2>() / 4.0, libm::atan2(along.y, along.x))
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.masses.len()
    }

    /// Returns true if there is no block.
    pub fn is_empty(&self) -> bool {
        self.masses.is_empty()
    }

    /// Advances by one step.
    pub fn step(&mut self) -> Report {
        self.integrate();
        let report = self.collide();
        std::mem::swap(&mut self.curr, &mut self.next);
        report
    }

    fn integrate(&mut self) {
        let c = self.constants;
        let h = c.step / f64::from(c.iterations);
        self.next.copy_from_slice(&self.curr);
        for _ in 0..c.iterations {
            for ((states, mass), rest) in self.next.chunks_exact_mut(4).zip(&self.masses).zip(&self.rest) {
                let mut forces = [DVec2::new(0.0, -mass * c.gravity); 4];
                for ([a, b], rest) in SPRINGS.into_iter().zip(rest) {
                    let apart = states[b].position - states[a].position;
                    let length = apart.length();
                    let closing = (states[b].velocity - states[a].velocity).dot(apart) / length;
                    // Eq. 4.1 and 4.3a, with the sign of `jenga3d::spring`.
                    let force = apart * ((-c.stiffness * (length - rest) - c.damping * closing) / length);
                    forces[b] += force; // Eq. 4.2b
                    forces[a] -= force; // Eq. 4.2b
                }
                for (state, force) in states.iter_mut().zip(forces) {
                    state.velocity += force / *mass * h; // Eq. 4.4
                    state.position += state.velocity * h; // Eq. 4.4
                }
            }
        }
    }

    fn collide(&mut self) -> Report {
        let mut report = Report::default();
        while report.sweeps < self.constants.max_sweeps {
            report.sweeps += 1;
            let mut found = 0;
            for a in 0..self.len() {
                for particle in 4 * a..4 * a + 4 {
                    found += u32::from(self.floor(particle));
                }
                for b in a + 1..self.len() {
                    for (points, edges) in [(a, b), (b, a)] {
                        for point in 4 * points..4 * points + 4 {
                            found += (0..EDGES).map(|e| u32::from(self.point_edge(point, edges, e))).sum::<u32>();
                        }
                    }
                }
            }
            report.collisions += found;
            if found == 0 {
                return report;
            }
        }
        report.unresolved = true;
        report
    }

    fn floor(&mut self, particle: usize) -> bool {
        if self.next[particle].position.y >= 0.0 {
            return false;
        }
        let (velocity, displacement) =
            (self.next[particle].velocity, self.next[particle].position - self.curr[particle].position);
        self.respond(&[(particle, 1.0)], DVec2::Y, velocity, displacement);
        self.next[particle].position.y = self.next[particle].position.y.max(0.0);
        true
    }

    /// Resolves the collision of a point that passes an edge from outside within the step, and
    /// returns true if there is one.
    fn point_edge(&mut self, point: usize, block: usize, edge: usize) -> bool {
        let [i, j] = SPRINGS[edge].map(|c| 4 * block + c);
        let (s, n) = (&self.curr, &self.next);
        // Three moving points on one line: in the plane Eq. 4.9 is of the second degree.
        let (a1, a2) = (s[j].position - s[i].position, s[point].position - s[i].position);
        let displacement = |k: usize| n[k].position - s[k].position;
        let (d1, d2) = (displacement(j) - displacement(i), displacement(point) - displacement(i));
        // Positive outside, which is on the right of the edge.
        let outside = Cubic { a: 0.0, b: d2.perp_dot(d1), c: a2.perp_dot(d1) + d2.perp_dot(a1), d: a2.perp_dot(a1) };
        if !outside.may_have_root() {
            return false;
        }
        for root in outside.crossings().as_slice().iter().filter(|root| root.descending) {
            let at = |k: usize| s[k].position + root.t * displacement(k);
            let along = at(j) - at(i);
            let mu = (at(point) - at(i)).dot(along) / along.length_squared();
            if !(-1e-6..=1.0 + 1e-6).contains(&mu) {
                continue;
            }
            let mu = mu.clamp(0.0, 1.0);
            let normal = -along.perp().normalize();
            let parts = [(point, 1.0), (i, mu - 1.0), (j, -mu)];
            let relative = |of: &dyn Fn(usize) -> DVec2| parts.iter().map(|&(k, w)| w * of(k)).sum::<DVec2>();
            let (velocity, displacement) = (relative(&|k| n[k].velocity), relative(&displacement));
            self.respond(&parts, normal, velocity, displacement);
            return true;
        }
        false
    }

    /// Applies Eq. 4.13 with weights to velocities and displacements, and Coulomb friction limited
    /// by the impulse, as [`respond`](crate::jenga3d::response::respond) does.
    fn respond(&mut self, parts: &[(usize, f64)], normal: DVec2, velocity: DVec2, displacement: DVec2) {
        let c = self.constants;
        let inverse_mass: f64 = parts.iter().map(|&(k, w)| w * w / self.masses[k / 4]).sum();
        let response = |relative: DVec2| {
            let along = -(1.0 + c.restitution) * relative.dot(normal).min(0.0) / inverse_mass; // Eq. 4.13
            let across = -(relative - relative.dot(normal) * normal) / inverse_mass;
            along * normal + across.clamp_length_max(c.friction * along)
        };
        let (impulse, shift) = (response(velocity), response(displacement));
        for &(k, w) in parts {
            let share = w / self.masses[k / 4];
            self.next[k].velocity += impulse * share; // Eq. 2.9
            self.next[k].position += shift * share;
        }
    }
}
