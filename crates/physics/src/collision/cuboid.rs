//! Oriented box.

use glam::{DMat3, DVec3};

use crate::body::middle_edge;

/// Oriented box in the world, with rounded edges.
#[derive(Debug, Clone, Copy, Default)]
pub struct Cuboid {
    /// Index of the body.
    pub body: u32,
    /// Centre, m.
    pub center: DVec3,
    /// Axes of the box, as columns.
    pub axes: DMat3,
    /// Half edge lengths, m.
    pub half: DVec3,
    /// Radius of the edges, m.
    pub radius: f64,
    /// True if the edges are rounded; the radius of sharp ones only gives them a normal.
    pub rounded: bool,
    /// Velocity of the centre, m/s.
    pub velocity: DVec3,
    /// Angular velocity, rad/s.
    pub spin: DVec3,
    /// Shortest time to the next detection, s.
    pub lookahead: f64,
    /// Mass over stiffness of the contacts, s²: inverse square of the angular frequency at which
    /// the body swings on a contact.
    pub softness: f64,
}

impl Cuboid {
    /// Core of the box, whose points are all one radius or more inside the surface; the rounded box
    /// is the core and a ball of that radius around each of its points.
    pub fn core(&self) -> Self {
        Self { half: self.half - DVec3::splat(self.radius), ..*self }
    }

    /// Velocity of a point of the box, m/s.
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(point - self.center)
    }

    /// Middle of the edge along axis `along` that lies farthest in a direction, m.
    #[inline]
    pub fn farthest_edge(&self, along: usize, direction: DVec3) -> DVec3 {
        let toward = self.axes.transpose() * direction;
        let mut local = DVec3::ZERO;
        for k in 0..3 {
            if k != along {
                local[k] = if toward[k] >= 0.0 { self.half[k] } else { -self.half[k] };
            }
        }
        self.center + self.axes * local
    }

    /// Axis whose face faces most against a direction, and the sign of that face.
    #[inline]
    pub fn facing(&self, direction: DVec3) -> Facing {
        let facing = self.axes.transpose() * direction;
        let axis = facing.abs().max_position();
        let sign = if facing[axis] > 0.0 { -1.0 } else { 1.0 };
        let (p, q) = (facing[(axis + 1) % 3], facing[(axis + 2) % 3]);
        Facing { axis, sign, sine: (p * p + q * q).sqrt() }
    }

    /// Right-handed contact frame in the box's coordinates, from a normal in the world and an axis
    /// of the box that is not parallel to it.
    pub fn contact_frame(&self, normal: DVec3, tangent_axis: usize) -> [DVec3; 3] {
        let n = self.axes.transpose() * normal;
        let mut t = DVec3::ZERO;
        t[tangent_axis] = 1.0;
        let t1 = (t - n * n.dot(t)).normalize();
        [n, t1, n.cross(t1)]
    }

    /// Length of the middle one of the three edges, m: the size of the block as far as its edges
    /// are concerned.
    pub fn middle_edge(&self) -> f64 {
        middle_edge(self.half)
    }
}

/// Face of a box that faces a direction.
#[derive(Debug, Clone, Copy)]
pub struct Facing {
    /// Axis across the face.
    pub axis: usize,
    /// Side of the axis.
    pub sign: f64,
    /// Sine of the angle between the face's normal and the direction.
    pub sine: f64,
}
