//! Resting contact by constraints (section 2.4.2): forces at contact points that prevent bodies
//! from accelerating into each other.

use glam::DVec2;

use super::body::Body;
use super::lcp::{self, LcpError};
use super::manifold::Point;

/// Contact point with its two bodies.
///
/// ```
/// use teeter_dissertation::flat::scene::stack;
/// use teeter_dissertation::flat::{Method, Rigid2D, rigid::Constants};
///
/// let world = Rigid2D::new(&stack(1, 0.0), Constants::of(Method::Constraint));
/// let contacts = world.contacts(1e-6);
/// assert_eq!(contacts.len(), 2);
/// assert_eq!(contacts[0].approach_velocity(&world.bodies), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Index of the body that the normal points to.
    pub a: usize,
    /// Index of the other body.
    pub b: usize,
    /// Contact point.
    pub point: Point,
}

impl Contact {
    /// Normal relative velocity, m/s; negative for approach (Eq. 2.8).
    pub fn approach_velocity(&self, bodies: &[Body]) -> f64 {
        let Point { position, normal, .. } = self.point;
        (bodies[self.a].velocity_at(position) - bodies[self.b].velocity_at(position)).dot(normal) // Eq. 2.8
    }

    /// Applies an impulse (N s) to the first body and its opposite to the second.
    pub fn apply_impulse(&self, bodies: &mut [Body], impulse: DVec2) {
        bodies[self.a].apply_impulse(impulse, self.point.position);
        bodies[self.b].apply_impulse(-impulse, self.point.position);
    }

    /// Applies the impulse of a collision to an approaching contact: Eq. 2.10 with (1 + e), see
    /// [`respond`](crate::jenga3d::response::respond), and Coulomb friction limited by it.
    pub fn collide(&self, bodies: &mut [Body], restitution: f64, friction: f64) {
        let approach = self.approach_velocity(bodies);
        if approach >= 0.0 {
            return;
        }
        let Point { position, normal, .. } = self.point;
        let j = -(1.0 + restitution) * approach / self.inverse_mass(bodies, normal); // Eq. 2.10
        let t = normal.perp();
        let sliding = (bodies[self.a].velocity_at(position) - bodies[self.b].velocity_at(position)).dot(t);
        let across = -sliding / self.inverse_mass(bodies, t);
        self.apply_impulse(bodies, j * normal + across.clamp(-friction * j, friction * j) * t);
    }

    /// Inverse mass of the contact along a direction, 1/kg: the denominator of Eq. 2.10.
    pub fn inverse_mass(&self, bodies: &[Body], along: DVec2) -> f64 {
        bodies[self.a].inverse_mass_at(self.point.position, along)
            + bodies[self.b].inverse_mass_at(self.point.position, along)
    }
}

/// Returns the normal forces, N, under gravity along -y (m/s²): a = A f + b (Eq. 2.16) with the
/// conditions of Eq. 2.13 to 2.15.
///
/// # Errors
/// When Dantzig's algorithm finds no solution.
pub fn forces(bodies: &[Body], contacts: &[Contact], gravity: f64) -> Result<Vec<f64>, LcpError> {
    // Normal relative acceleration at contact i for a unit force at contact j.
    let effect = |i: &Contact, j: &Contact| {
        let mut sum = 0.0;
        for (of_i, side_i) in [(i.a, 1.0), (i.b, -1.0)] {
            for (of_j, side_j) in [(j.a, 1.0), (j.b, -1.0)] {
                if of_i == of_j {
                    let body = &bodies[of_i];
                    let linear = body.inverse_mass * i.point.normal.dot(j.point.normal);
                    let arm = |t: &Contact| (t.point.position - body.centre).perp_dot(t.point.normal);
                    sum += side_i * side_j * (linear + body.inverse_inertia * arm(i) * arm(j));
                }
            }
        }
        sum
    };
    let matrix: Vec<Vec<f64>> = contacts.iter().map(|i| contacts.iter().map(|j| effect(i, j)).collect()).collect();
    let b: Vec<f64> = contacts
        .iter()
        .map(|i| {
            // Acceleration of a point without contact forces: gravity and centripetal acceleration.
            let acceleration = |n: usize| {
                let body = &bodies[n];
                let fall = if body.inverse_mass > 0.0 { DVec2::new(0.0, -gravity) } else { DVec2::ZERO };
                fall - body.spin * body.spin * (i.point.position - body.centre)
            };
            let turning = bodies[if i.point.of_first { i.a } else { i.b }].spin * i.point.normal.perp();
            let velocity = bodies[i.a].velocity_at(i.point.position) - bodies[i.b].velocity_at(i.point.position);
            (acceleration(i.a) - acceleration(i.b)).dot(i.point.normal) + 2.0 * turning.dot(velocity)
        })
        .collect();
    lcp::solve(&matrix, &b) // Eq. 2.16
}
