//! Cross-section of a card, and the height at which one rests on another.

use glam::{DQuat, DVec2, DVec3};

/// Rounded rectangle in the plane of x and z.
#[derive(Debug, Clone, Copy)]
pub struct Section {
    /// Centre, m.
    pub centre: DVec2,
    /// Angle of the first edge above the x axis, rad.
    pub angle: f64,
    /// Half edges of the core, m.
    core: DVec2,
}

impl Section {
    /// Section of these edge lengths (m) with edges of this radius (m), about the origin.
    pub fn new(edges: DVec2, radius: f64, angle: f64) -> Self {
        Self { centre: DVec2::ZERO, angle, core: 0.5 * edges - radius }
    }

    /// Half the extent of the core along x, m.
    pub fn half_width(&self) -> f64 {
        let (sin, cos) = libm::sincos(self.angle);
        self.core.x * cos.abs() + self.core.y * sin.abs()
    }

    /// Half the extent of the core along z, m.
    pub fn half_height(&self) -> f64 {
        let (sin, cos) = libm::sincos(self.angle);
        self.core.x * sin.abs() + self.core.y * cos.abs()
    }

    /// Returns the section turned about the origin by an angle, rad, then moved.
    pub fn moved(&self, angle: f64, by: DVec2) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let centre = DVec2::new(cos, sin).rotate(self.centre) + by;
        Self { centre, angle: self.angle + angle, ..*self }
    }

    /// Rotation of a block whose length is along the first edge.
    pub fn rotation(&self) -> DQuat {
        let (sin, cos) = libm::sincos(-0.5 * self.angle);
        DQuat::from_array([0.0, sin, 0.0, cos])
    }

    /// Centre in space, in the plane y = 0.
    pub fn position(&self) -> DVec3 {
        DVec3::new(self.centre.x, 0.0, self.centre.y)
    }

    fn corners(&self) -> [DVec2; 4] {
        let (sin, cos) = libm::sincos(self.angle);
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(u, v)| self.centre + DVec2::new(cos, sin).rotate(self.core * DVec2::new(u, v)))
    }

    /// Displacement along z that lays this section on another one, both with edges of this radius
    /// (m); negative infinity where it is beside the other one.
    ///
    /// The cores are then twice the radius apart. So the displacement is the height, at x = 0, of
    /// the Minkowski difference of the cores with a disc of that radius around it: an arc around
    /// one of its corners, or a line beside one of its edges. Differences of corners that are no
    /// corner of it are inside, and reach less high.
    pub fn height_on(&self, other: &Self, radius: f64) -> f64 {
        let reach = 2.0 * radius;
        if (self.centre.x - other.centre.x).abs() > self.core.length() + other.core.length() + reach {
            return f64::NEG_INFINITY;
        }
        let mine = self.corners();
        let differences = other.corners().map(|b| mine.map(|a| b - a));
        let differences = differences.as_flattened();
        let arcs = differences.iter().filter(|d| d.x.abs() <= reach).map(|d| d.y + (reach * reach - d.x * d.x).sqrt());
        let lines = differences.iter().enumerate().flat_map(|(i, a)| {
            differences[i + 1..].iter().filter_map(move |b| {
                let (left, right) = if a.x < b.x { (a, b) } else { (b, a) };
                let edge = *right - *left;
                let normal = edge.perp().normalize_or_zero();
                let (left, right) = (*left + reach * normal, *right + reach * normal);
                let share = -left.x / edge.x;
                (edge.x > 0.0 && (0.0..=1.0).contains(&share)).then_some(left.y + share * (right.y - left.y))
            })
        });
        arcs.chain(lines).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Displacement along z that lays this section, with edges of this radius (m), on the floor.
    pub fn height_on_floor(&self, radius: f64) -> f64 {
        self.half_height() + radius - self.centre.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EDGES: DVec2 = DVec2::new(0.09, 0.01);

    #[test]
    fn a_level_section_rests_on_a_level_one_at_its_height() {
        for radius in [0.0, 0.001] {
            let (a, b) = (Section::new(EDGES, radius, 0.0), Section::new(EDGES, radius, 0.0));
            let b = b.moved(0.0, DVec2::new(0.03, 0.2));
            assert!((a.height_on(&b, radius) - 0.21).abs() < 1e-15);
            assert!((a.height_on_floor(radius) - 0.005).abs() < 1e-15);
            assert_eq!(a.height_on(&b.moved(0.0, DVec2::new(0.07, 0.0)), radius), f64::NEG_INFINITY);
        }
    }

    /// An edge in a flank: the distance of a point from a line.
    #[test]
    fn a_level_section_rests_on_the_edge_of_a_leaning_one() {
        let angle = 0.7f64;
        let (sin, cos) = libm::sincos(angle);
        for radius in [0.0, 0.001] {
            let leaning = Section::new(EDGES, radius, angle);
            let top = (0.045 - radius) * sin + (0.005 - radius) * cos + radius;
            let level = Section::new(EDGES, radius, 0.0);
            assert!((level.height_on(&leaning, radius) - (top + 0.005)).abs() < 1e-15);
            assert!((leaning.height_on_floor(radius) - top).abs() < 1e-15);
        }
    }

    /// Two edges that meet beside each other's highest point: an arc on an arc.
    #[test]
    fn edges_that_meet_obliquely_are_twice_the_radius_apart() {
        let radius = 0.001;
        let square = Section::new(DVec2::splat(0.01), radius, std::f64::consts::FRAC_PI_4);
        let beside = square.moved(0.0, DVec2::new(0.001, 0.0));
        let core = 2.0 * 0.004 * 2f64.sqrt();
        let expected = core + (4e-6f64 - 1e-6).sqrt();
        assert!((square.height_on(&beside, radius) - expected).abs() < 1e-15);
    }
}
