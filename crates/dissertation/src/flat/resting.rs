//! Resting contact by constraints (section 2.4.2): the forces at contact points that keep bodies from accelerating into each other.

use glam::DVec2;

use super::body::Body;
use super::lcp::{self, LcpError};
use super::manifold::Point;

/// A contact point and its two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Index of the body that the normal points to.
    pub a: usize,
    /// Index of the other.
    pub b: usize,
    /// The point.
    pub point: Point,
}

impl Touch {
    /// Relative velocity along the normal, m/s; negative for approach (Eq. 2.8).
    pub fn approach(&self, bodies: &[Body]) -> f64 {
        let Point { place, normal, .. } = self.point;
        (bodies[self.a].velocity_at(place) - bodies[self.b].velocity_at(place)).dot(normal) // Eq. 2.8
    }

    /// Applies an impulse along the normal, N s.
    pub fn push(&self, bodies: &mut [Body], impulse: DVec2) {
        bodies[self.a].push(impulse, self.point.place);
        bodies[self.b].push(-impulse, self.point.place);
    }

    /// Denominator of Eq. 2.10, 1/kg, along a direction.
    pub fn inverse_mass(&self, bodies: &[Body], along: DVec2) -> f64 {
        bodies[self.a].inverse_mass_at(self.point.place, along)
            + bodies[self.b].inverse_mass_at(self.point.place, along)
    }
}

/// The forces along the normals, N, under gravity along -y (m/s²): a = A f + b (Eq. 2.16) with the conditions of Eq. 2.13 to 2.15.
///
/// # Errors
/// When Dantzig's algorithm finds none.
pub fn forces(bodies: &[Body], touches: &[Touch], gravity: f64) -> Result<Vec<f64>, LcpError> {
    // What a unit force of contact j does to the relative acceleration along the normal at contact i.
    let effect = |i: &Touch, j: &Touch| {
        let mut sum = 0.0;
        for (of_i, side_i) in [(i.a, 1.0), (i.b, -1.0)] {
            for (of_j, side_j) in [(j.a, 1.0), (j.b, -1.0)] {
                if of_i == of_j {
                    let body = &bodies[of_i];
                    let linear = body.inverse_mass * i.point.normal.dot(j.point.normal);
                    let arm = |t: &Touch| (t.point.place - body.centre).perp_dot(t.point.normal);
                    sum += side_i * side_j * (linear + body.inverse_inertia * arm(i) * arm(j));
                }
            }
        }
        sum
    };
    let matrix: Vec<Vec<f64>> = touches.iter().map(|i| touches.iter().map(|j| effect(i, j)).collect()).collect();
    let b: Vec<f64> = touches
        .iter()
        .map(|i| {
            // Acceleration of a body's point without contact forces: gravity, and what its spin does to an arm.
            let acceleration = |n: usize| {
                let body = &bodies[n];
                let fall = if body.inverse_mass > 0.0 { DVec2::new(0.0, -gravity) } else { DVec2::ZERO };
                fall - body.spin * body.spin * (i.point.place - body.centre)
            };
            let turning = bodies[if i.point.of_first { i.a } else { i.b }].spin * i.point.normal.perp();
            let velocity = bodies[i.a].velocity_at(i.point.place) - bodies[i.b].velocity_at(i.point.place);
            (acceleration(i.a) - acceleration(i.b)).dot(i.point.normal) + 2.0 * turning.dot(velocity)
        })
        .collect();
    lcp::solve(&matrix, &b) // Eq. 2.16
}
