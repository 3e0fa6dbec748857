//! Rigid rectangles (section 2.2.1).

use glam::DVec2;

use super::scene::Rectangle;

/// Rigid rectangle with its pose and velocity.
///
/// ```
/// use glam::DVec2;
/// use teeter_dissertation::flat::body::Body;
/// use teeter_dissertation::flat::scene::stack;
///
/// let mut body = Body::new(&stack(1, 0.0)[0]);
/// body.apply_impulse(0.0196 * DVec2::X, body.centre);
/// assert_eq!((body.velocity, body.spin), (DVec2::X, 0.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Half side lengths, m.
    pub half: DVec2,
    /// Inverse mass, 1/kg; 0 for a fixed body.
    pub inverse_mass: f64,
    /// Inverse moment of inertia, 1/(kg m²).
    pub inverse_inertia: f64,
    /// Position of the centre, m.
    pub centre: DVec2,
    /// Rotation, rad.
    pub angle: f64,
    /// Velocity of the centre, m/s.
    pub velocity: DVec2,
    /// Angular velocity, rad/s.
    pub spin: f64,
}

impl Body {
    /// Creates a body at rest.
    pub fn new(block: &Rectangle) -> Self {
        let inertia = block.mass * block.size.length_squared() / 12.0;
        Self {
            half: 0.5 * block.size,
            inverse_mass: 1.0 / block.mass,
            inverse_inertia: 1.0 / inertia,
            centre: block.centre,
            angle: 0.0,
            velocity: DVec2::ZERO,
            spin: 0.0,
        }
    }

    /// Creates the floor, whose upper side is y = 0.
    pub fn floor() -> Self {
        let half = DVec2::new(10.0, 0.5);
        let centre = DVec2::new(0.0, -half.y);
        Self { half, inverse_mass: 0.0, inverse_inertia: 0.0, centre, angle: 0.0, velocity: DVec2::ZERO, spin: 0.0 }
    }

    /// Unit vectors along the sides.
    pub fn axes(&self) -> [DVec2; 2] {
        let x = DVec2::new(libm::cos(self.angle), libm::sin(self.angle));
        [x, x.perp()]
    }

    /// Corners, counter-clockwise.
    pub fn corners(&self) -> [DVec2; 4] {
        let [x, y] = self.axes();
        let (x, y) = (x * self.half.x, y * self.half.y);
        [self.centre - x - y, self.centre + x - y, self.centre + x + y, self.centre - x + y]
    }

    /// Velocity of a point of the body, m/s.
    pub fn velocity_at(&self, point: DVec2) -> DVec2 {
        self.velocity + self.spin * (point - self.centre).perp() // Eq. 2.5
    }

    /// Applies an impulse (N s) at a point.
    pub fn apply_impulse(&mut self, impulse: DVec2, point: DVec2) {
        self.velocity += self.inverse_mass * impulse; // Eq. 2.9
        self.spin += self.inverse_inertia * (point - self.centre).perp_dot(impulse);
    }

    /// Inverse mass of a point along `n`, 1/kg: the term of this body in the denominator of Eq.
    /// 2.10.
    pub fn inverse_mass_at(&self, point: DVec2, n: DVec2) -> f64 {
        let arm = (point - self.centre).perp_dot(n);
        self.inverse_mass + arm * arm * self.inverse_inertia
    }

    /// Returns the body after a time (s) at constant velocities.
    pub fn advanced(&self, time: f64) -> Self {
        Self { centre: self.centre + time * self.velocity, angle: self.angle + time * self.spin, ..*self }
    }

    /// Returns the body between two poses, at t from 0 to 1, with the velocities of `end`.
    pub fn interpolate(start: &Self, end: &Self, t: f64) -> Self {
        Self { centre: start.centre.lerp(end.centre, t), angle: start.angle + t * (end.angle - start.angle), ..*end }
    }

    /// Kinetic energy, J; 0 for a fixed body.
    pub fn energy(&self) -> f64 {
        if self.inverse_mass == 0.0 {
            return 0.0;
        }
        0.5 * self.velocity.length_squared() / self.inverse_mass + 0.5 * self.spin * self.spin / self.inverse_inertia
    }
}
