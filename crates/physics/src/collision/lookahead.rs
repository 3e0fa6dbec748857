//! Contacts of fast bodies, which travel by more than the radius of an edge before the next
//! detection.
//!
//! The normal of rounded edges turns as they pass each other, and is fixed between detections. It
//! is taken where the edges will meet; and where the bodies will by then lie face on face, the
//! faces make the contact at once.

use glam::DVec3;

use crate::collision::cuboid::Cuboid;
use crate::collision::manifold::Manifold;
use crate::collision::nearest::{Feature, Nearest};

/// Depth at which faces may meet, over the speed and the contact time: pressing them apart gives
/// less than a thousandth of the energy of the motion.
const MAX_DEPTH: f64 = 0.03;
/// Travel of the edges before the next detection from which normals are predicted, over the sum of
/// their radii.
const MIN_TRAVEL: f64 = 0.1;

/// Motion of two boxes against each other at their nearest points until the next detection.
#[derive(Debug, Clone, Copy)]
pub struct Approach {
    /// Velocity of the second box against the first, m/s.
    velocity: DVec3,
    /// Time, s.
    time: f64,
    /// Sum of the radii, m.
    radius: f64,
    /// Depth that faces may have, m.
    max_depth: f64,
}

impl Approach {
    /// Motion of two boxes at their nearest points; none where they hardly move.
    pub fn new(a: &Cuboid, b: &Cuboid, nearest: &Nearest) -> Option<Self> {
        let [p, q] = nearest.points;
        let velocity = b.velocity_at(q) - a.velocity_at(p);
        let (time, radius) = (a.lookahead.max(b.lookahead), a.radius + b.radius);
        let speed = velocity.length();
        let max_depth = MAX_DEPTH * speed * a.softness.min(b.softness).sqrt();
        (speed * time > MIN_TRAVEL * radius).then_some(Self { velocity, time, radius, max_depth })
    }

    /// Box after the motion.
    pub fn moved(&self, b: &Cuboid) -> Cuboid {
        Cuboid { center: b.center + self.velocity * self.time, ..*b }
    }

    /// Moves the points of a manifold of faces, found after the motion, back to the present. They
    /// stay on the face of A where they will then be.
    /// Returns false where the faces are deeper in each other than may be.
    pub fn bring_back(&self, a: &Cuboid, b: &Cuboid, to: &mut Manifold) -> bool {
        let (reference, velocity) = if to.a == a.body { (a, self.velocity) } else { (b, -self.velocity) };
        let change = (reference.axes * to.frame[0]).dot(velocity) * self.time;
        let deepest = to.deepest();
        for point in &mut to.points {
            point.gap -= change;
            point.follows = [false; 2];
        }
        deepest <= self.max_depth
    }

    /// Nearest points with the normal that they will have when the edges touch, or at the end of
    /// the motion where they will not; halfway for edges that touch already.
    pub fn turned(&self, a: &Cuboid, b: &Cuboid, nearest: &Nearest) -> Nearest {
        let offset = nearest.points[1] - nearest.points[0];
        let mut velocity = self.velocity;
        for (c, feature) in [a, b].into_iter().zip(nearest.features) {
            if let Feature::Edge(axis) = feature {
                let along = c.axes.col(axis);
                velocity -= along * along.dot(velocity);
            }
        }
        let time = if nearest.distance < self.radius { 0.5 * self.time } else { self.meeting(offset, velocity) };
        let normal = (offset + velocity * time).try_normalize().filter(|n| n.dot(nearest.normal) > 0.0);
        Nearest { normal: normal.unwrap_or(nearest.normal), ..*nearest }
    }

    /// Time until the offset (m) is as long as both radii, or is shortest; at most that of the
    /// motion.
    fn meeting(&self, offset: DVec3, velocity: DVec3) -> f64 {
        let (square, closing) = (velocity.length_squared(), -offset.dot(velocity));
        if closing <= 0.0 || square <= 0.0 {
            return 0.0;
        }
        let root = closing * closing - square * (offset.length_squared() - self.radius * self.radius);
        ((closing - root.max(0.0).sqrt()) / square).min(self.time)
    }
}
