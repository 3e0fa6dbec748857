//! Relative motion of the two bodies of a contact.

use crate::body::Bodies;
use crate::collision::friction_levers::Slip;
use crate::collision::manifold::Manifold;

/// Motion of B relative to A at the centroid of their manifold, along its frame.
#[derive(Debug, Clone, Copy, Default)]
pub struct RelativeTwist {
    /// Velocity along normal, tangent, tangent, m/s.
    velocity: [f64; 3],
    /// Spin about normal, tangent, tangent, rad/s.
    spin: [f64; 3],
}

impl RelativeTwist {
    /// Motion of the bodies of a manifold.
    pub fn of(manifold: &Manifold, bodies: &Bodies) -> Self {
        let (center_a, axes_a) = bodies.pose(manifold.a);
        let frame = manifold.frame_in_world(bodies, axes_a);
        let at = center_a + axes_a * manifold.centroid;
        let [(velocity_a, spin_a), (velocity_b, spin_b)] = [manifold.a, manifold.b].map(|i| bodies.twist_at(i, at));
        Self {
            velocity: frame.map(|axis| axis.dot(velocity_b - velocity_a)),
            spin: frame.map(|axis| axis.dot(spin_b - spin_a)),
        }
    }

    /// Speed at which a gap grows at an offset from the centroid (m), m/s.
    pub fn opening(&self, [x, y]: [f64; 2]) -> f64 {
        self.velocity[0] + self.spin[1] * y - self.spin[2] * x
    }

    /// Slip at an offset from the centroid (m).
    pub fn slip(&self, [x, y]: [f64; 2]) -> Slip {
        let [_, u, v] = self.velocity;
        Slip { velocity: [u - self.spin[0] * y, v + self.spin[0] * x], spin: self.spin[0] }
    }
}
