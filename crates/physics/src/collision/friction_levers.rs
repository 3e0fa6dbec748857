//! Levers of friction: where the friction of a patch acts, and how far it turns on the spot.
//!
//! A patch under uniform pressure is divided into quarters, one for each corner. Friction of a
//! quarter acts at its lever, against sliding there and against its turning about itself; the three
//! components share one cone. A square divides into two by two squares, a long patch into four
//! strips in a row, so that the quarters stay compact. The levers are a linear map of the corners'
//! offsets from the centre of pressure, so the resultant acts there whatever the pressure is.
//!
//! The levers depend on the slip. A patch that turns about a centre within it, or sticks, has the
//! levers of a pure spin. One that slides past has the centroids of its quarters and turns about
//! them by its second moments. A quarter that has the centre of rotation in it turns by a longer
//! arm, or it would be as hard to slide as one that slides as a whole.

use serde::{Deserialize, Serialize};

use crate::constants::STRIBECK_SPEED;

/// Ratio of the sides from which a patch is divided into a row of four, and below which into two by
/// two.
const ROW_RATIO: (f64, f64) = (1.3, 2.5);
/// Levers over the offsets of the corners in a square.
const SQUARE: f64 = 0.462;
/// Change of the levers along the long side from a square to a row.
const ROW: f64 = 0.015;
/// Second moment of a uniform pressure over that of its forces at the corners: exact for
/// parallelograms, 1/4 for triangles, 5/12 for regular hexagons.
const PRESSURE_MOMENT: f64 = 1.0 / 3.0;
/// Iterations that find the turning arm: each squares the relative error.
const TURN_ITERATIONS: usize = 4;

/// Distance of the centre of rotation from the centre of pressure, over the extent of the patch in
/// that direction, at which the levers are halfway between those of spinning and of sliding: for
/// two by two quarters, and for a row.
const SLIDING_RATIO: (f64, f64) = (0.4, 1.23);
/// Growth of the square of the turning arm of a quarter that has the centre of rotation at its
/// lever, relative; strips have none.
const ARM_GROWTH: f64 = 1.3;
/// Distance of the centre of rotation from a lever, over the extent of the patch, at which half of
/// that growth is left.
const ARM_REACH: f64 = 0.38;

/// Levers over the offsets of the ends of an edge: the centroids of its halves.
const EDGE: f64 = 0.5;

/// Relative motion of the two bodies of a patch at its centre of pressure.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Slip {
    /// Velocity along the two tangents, m/s.
    pub velocity: [f64; 2],
    /// Spin about the normal, rad/s.
    pub spin: f64,
}

impl Slip {
    /// Returns true for the square of a speed (m²/s²) at which levers are those of a patch that
    /// sticks but for a millionth.
    pub fn is_negligible(squared_speed: f64) -> bool {
        squared_speed < (0.01 * STRIBECK_SPEED) * (0.01 * STRIBECK_SPEED)
    }
}

/// Levers of friction of a patch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionLevers {
    /// Levers of a patch that spins or sticks, over the offset from the centre of pressure, both
    /// along the two tangents.
    pub map: [[f64; 2]; 2],
    /// Arm of a quarter's own turning over the length of the offset, of a patch that spins or
    /// sticks.
    pub turn: f64,
    /// Levers of a patch that slides: the centroids of its quarters.
    pub sliding_map: [[f64; 2]; 2],
    /// Second moments of the corners: along the first tangent, of both, along the second, m².
    pub moments: [f64; 3],
    /// Division of the patch: 0 for two by two quarters, 1 for a row of four.
    pub row: f64,
}

/// Levers of a patch at a slip.
#[derive(Debug, Clone, Copy, Default)]
pub struct SlipLevers {
    map: [[f64; 2]; 2],
    /// Square of the turning arm over that of the offset.
    turn_squared: f64,
    slip: Slip,
    /// Relative growth of the square of the turning arm at the centre of rotation.
    growth: f64,
    /// Square of the speed of a lever at which half of the growth is left, m²/s².
    reach: f64,
}

impl FrictionLevers {
    /// Levers of a patch with corners at `offsets` from its centroid (m) that carry `shares` of the
    /// force. `torsion_ratio` is the torsional friction of its pressure over that of forces at the
    /// corners, which the levers reproduce exactly.
    pub fn new(offsets: &[[f64; 2]], shares: &[f64], torsion_ratio: f64) -> Self {
        let moments = second_moments(offsets, shares);
        let (ratio, axis) = principal_axis(moments);
        let row = row_share(ratio);
        let [spinning, sliding] = quarters(ratio, row).map(|quarters| lever_map(quarters, ratio, axis));
        let levers = Self { map: spinning, turn: 0.0, sliding_map: sliding, moments, row };
        let arms =
            offsets.iter().zip(shares).map(|(offset, share)| (apply(&levers.map, *offset), length(*offset), *share));
        levers.with_torsion(arms.collect::<arrayvec::ArrayVec<_, 8>>().as_slice(), torsion_ratio)
    }

    /// Levers of a patch that has turned about the normal by an angle of this cosine and sine.
    pub fn turned(self, [c, s]: [f64; 2]) -> Self {
        let turn = |[[a, b], [d, e]]: [[f64; 2]; 2]| {
            let [p, q] = [[c * a - s * d, c * b - s * e], [s * a + c * d, s * b + c * e]];
            [[c * p[0] - s * p[1], s * p[0] + c * p[1]], [c * q[0] - s * q[1], s * q[0] + c * q[1]]]
        };
        let [xx, xy, yy] = self.moments;
        let [[xx, xy], [_, yy]] = turn([[xx, xy], [xy, yy]]);
        Self { map: turn(self.map), sliding_map: turn(self.sliding_map), moments: [xx, xy, yy], ..self }
    }

    /// Levers at a slip.
    ///
    /// Below [`STRIBECK_SPEED`] they approach those of a patch that sticks, with the square of the
    /// speed and more: a centre of rotation has no meaning there.
    pub fn at(&self, slip: &Slip) -> SlipLevers {
        if *slip == Slip::default() {
            return SlipLevers { map: self.map, turn_squared: self.turn * self.turn, ..SlipLevers::default() };
        }
        let [xx, xy, yy] = self.moments;
        let extent = 0.5 * (xx + yy);
        let threshold = STRIBECK_SPEED * STRIBECK_SPEED;
        let turning = extent * slip.spin * slip.spin;
        // Squared distance of the centre of rotation, (-v, u) / spin, in units of the patch.
        let determinant = xx * yy - xy * xy;
        let past = self.moment_along(slip.velocity)
            / (determinant * slip.spin * slip.spin + extent * threshold).max(f64::MIN_POSITIVE);
        let half = SLIDING_RATIO.0 + self.row * (SLIDING_RATIO.1 - SLIDING_RATIO.0);
        let sliding = past * past / (half * half * half * half + past * past);
        let mix = |spinning: f64, slid: f64| spinning + sliding * (slid - spinning);
        let map = [0, 1].map(|i| [0, 1].map(|j| mix(self.map[i][j], self.sliding_map[i][j])));
        SlipLevers {
            map,
            turn_squared: mix(self.turn * self.turn, self.sliding_turn_squared(slip.velocity)),
            slip: *slip,
            growth: (1.0 - self.row) * ARM_GROWTH * turning / (turning + threshold),
            reach: ARM_REACH * ARM_REACH * turning + threshold,
        }
    }

    /// Square of the turning arm over that of the offset where the patch slides along `direction`
    /// (any length): what the second moment of a uniform pressure exceeds that of the levers by.
    fn sliding_turn_squared(&self, [u, v]: [f64; 2]) -> f64 {
        let [xx, _, yy] = self.moments;
        let [[a, b], [c, d]] = self.sliding_map;
        // The second moment of levers along a direction is that of the corners along its transform.
        let levers = self.moment_along([a * u + c * v, b * u + d * v]);
        let square = (u * u + v * v) * (xx + yy);
        if square > 0.0 { ((PRESSURE_MOMENT * self.moment_along([u, v]) - levers) / square).max(0.0) } else { 0.0 }
    }

    /// Second moment of the corners along a direction, times the square of its length.
    fn moment_along(&self, [x, y]: [f64; 2]) -> f64 {
        let [xx, xy, yy] = self.moments;
        xx * x * x + 2.0 * xy * x * y + yy * y * y
    }

    /// Sets the turning arms so that the levers resist a pure spin as the pressure does. `arms` are
    /// lever (m), distance (m) and share of each corner.
    fn with_torsion(mut self, arms: &[([f64; 2], f64, f64)], torsion_ratio: f64) -> Self {
        let total: f64 = arms.iter().map(|(_, distance, share)| share * distance).sum();
        let target = torsion_ratio * total;
        let own: f64 = arms.iter().map(|(lever, _, share)| share * length(*lever)).sum();
        if total <= 0.0 {
            let map = [[torsion_ratio, 0.0], [0.0, torsion_ratio]];
            return Self { map, turn: 0.0, sliding_map: map, ..self };
        }
        if own >= target {
            let scale = target / own;
            self.map = self.map.map(|row| row.map(|x| x * scale));
            return self;
        }
        // Newton's method on the square of the turn, on which the sum of the roots is concave: from
        // below it rises to the solution.
        let mut square = 0.0;
        for _ in 0..TURN_ITERATIONS {
            let (mut sum, mut slope) = (-target, 0.0);
            for (lever, distance, share) in arms {
                let d2 = distance * distance;
                let root = (lever[0] * lever[0] + lever[1] * lever[1] + square * d2).sqrt();
                if root > 0.0 {
                    sum += share * root;
                    slope += share * 0.5 * d2 / root;
                }
            }
            if slope <= 0.0 {
                break;
            }
            square = (square - sum / slope).max(0.0);
        }
        self.turn = square.sqrt();
        self
    }
}

impl SlipLevers {
    /// Levers of a patch that bears on an edge or a corner.
    ///
    /// The quarters of a long patch lie in a row along it: those of its ends would be far from an
    /// end on which it stands, and above or below the plane of the contact.
    pub fn of_edge() -> Self {
        Self { map: [[EDGE, 0.0], [0.0, EDGE]], ..Self::default() }
    }

    /// Levers between those of an edge and these, of a patch that is flat to this share, from 0 to
    /// 1.
    pub fn mixed_with_edge(mut self, flat: f64) -> Self {
        let edge = Self::of_edge();
        for (row, edge) in self.map.iter_mut().zip(edge.map) {
            for (lever, edge) in row.iter_mut().zip(edge) {
                *lever = edge + flat * (*lever - edge);
            }
        }
        self.turn_squared *= flat;
        self.growth *= flat;
        self
    }

    /// Lever along the two tangents, and turning arm, of a corner at `offset` from the centre of
    /// pressure, m.
    pub fn arms(&self, offset: [f64; 2]) -> [f64; 3] {
        let [x, y] = apply(&self.map, offset);
        let turn_squared = self.turn_squared * (1.0 + self.growth_at([x, y]));
        [x, y, (turn_squared * (offset[0] * offset[0] + offset[1] * offset[1])).sqrt()]
    }

    /// Growth of the square of the turning arm at a lever (m), relative.
    fn growth_at(&self, [x, y]: [f64; 2]) -> f64 {
        if self.growth == 0.0 {
            return 0.0;
        }
        let left = |[u, v]: [f64; 2]| {
            let past = (u * u + v * v) / self.reach;
            1.0 / (1.0 + past * past)
        };
        // A pure spin keeps its arms, which are exact.
        let pure = [-self.slip.spin * y, self.slip.spin * x];
        let near = left([self.slip.velocity[0] + pure[0], self.slip.velocity[1] + pure[1]]) - left(pure);
        self.growth * near.max(0.0)
    }
}

/// Share of the division into a row of four at a ratio of the sides.
fn row_share(ratio: f64) -> f64 {
    let t = ((ratio - ROW_RATIO.0) / (ROW_RATIO.1 - ROW_RATIO.0)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Levers along the long side, their shear and levers across it, over the offsets of the corners of
/// a rectangle with this ratio of its sides: of spinning, and of sliding.
///
/// Those of sliding are the centroids of the quarters. Those of spinning fit a fine mesh under
/// uniform pressure.
fn quarters(ratio: f64, row: f64) -> [[f64; 3]; 2] {
    // Logarithms over those of the ratios 4 and 2.
    let long = libm::log(ratio.clamp(1.0, 20.0));
    let along = SQUARE + ROW * row - 0.028 * (long - 1.386).max(0.0);
    let spinning = [along, row * (0.207 + 0.03 * (long - 0.693).max(0.0)), SQUARE * (1.0 - row)];
    [spinning, [0.5, 0.25 * row, 0.5 * (1.0 - row)]]
}

/// Map of offsets to levers, both along the tangents, from [`quarters`] and the long axis.
fn lever_map([along, shear, across]: [f64; 3], ratio: f64, [c, s]: [f64; 2]) -> [[f64; 2]; 2] {
    // Shear couples the two normalised axes: it leads from across to along.
    let shear = shear * ratio;
    [
        [along * c * c - shear * c * s + across * s * s, along * c * s + shear * c * c - across * c * s],
        [along * c * s - shear * s * s - across * c * s, along * s * s + shear * c * s + across * c * c],
    ]
}

/// Second moments of corners that carry `shares` of the force, m².
fn second_moments(offsets: &[[f64; 2]], shares: &[f64]) -> [f64; 3] {
    let mut moments = [0.0; 3];
    for ([x, y], share) in offsets.iter().zip(shares) {
        moments[0] += share * x * x;
        moments[1] += share * x * y;
        moments[2] += share * y * y;
    }
    moments
}

/// Ratio of the extents of a patch along its principal axes, and the long one as a unit vector.
fn principal_axis([xx, xy, yy]: [f64; 3]) -> (f64, [f64; 2]) {
    let half = 0.5 * (xx - yy);
    let radius = (half * half + xy * xy).sqrt();
    let mean = 0.5 * (xx + yy);
    if radius <= 1e-9 * mean {
        return (1.0, [1.0, 0.0]);
    }
    // Half the angle of (half, xy), without trigonometry.
    let cosine = (0.5 * (1.0 + half / radius)).sqrt();
    let sine = (0.5 * (1.0 - half / radius)).sqrt();
    let ratio = ((mean + radius) / (mean - radius).max(1e-6 * mean)).sqrt();
    (ratio, [cosine, if xy < 0.0 { -sine } else { sine }])
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

fn apply(map: &[[f64; 2]; 2], offset: [f64; 2]) -> [f64; 2] {
    map.map(|row| row[0] * offset[0] + row[1] * offset[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::polygon::{Corner, Patch};

    const HALF: [f64; 2] = [0.04, 0.013];

    /// Levers of a rectangle, and the offsets of its corners.
    fn rectangle([a, b]: [f64; 2], angle: f64) -> (FrictionLevers, [[f64; 2]; 4]) {
        let (s, c) = libm::sincos(angle);
        let offsets = [[a, b], [-a, b], [-a, -b], [a, -b]].map(|[x, y]| [c * x - s * y, s * x + c * y]);
        let patch = Patch::new(&offsets.map(|[u, v]| Corner { u, v, gap: 0.0 }));
        (FrictionLevers::new(&offsets, &patch.shares[..4], patch.torsion_ratio), offsets)
    }

    /// Torque of the friction of quarters with equal shares, over the force of friction, m.
    fn torque(levers: &FrictionLevers, offsets: &[[f64; 2]; 4], slip: &Slip) -> f64 {
        let at = levers.at(slip);
        let torque = |offset: &[f64; 2]| {
            let [x, y, turn] = at.arms(*offset);
            let [u, v] = [slip.velocity[0] - slip.spin * y, slip.velocity[1] + slip.spin * x];
            let turning = slip.spin * turn;
            (x * v - y * u + turning * turn) / (u * u + v * v + turning * turning).sqrt()
        };
        0.25 * offsets.iter().map(torque).sum::<f64>()
    }

    #[test]
    fn a_patch_that_slides_turns_against_the_second_moment_of_its_pressure() {
        for (half, angle) in [(HALF, 0.0), (HALF, 0.5), ([0.03, 0.03], 0.7), ([0.03, 0.02], 2.0)] {
            let (levers, offsets) = rectangle(half, angle);
            for direction in 0..8 {
                let (sine, cosine) = libm::sincos(0.4 * f64::from(direction));
                let slip = Slip { velocity: [cosine, sine], spin: 0.5 };
                let along = libm::cos(0.4 * f64::from(direction) - angle);
                let second_moment =
                    (half[0] * half[0] * along * along + half[1] * half[1] * (1.0 - along * along)) / 3.0;
                let error = torque(&levers, &offsets, &slip) / (0.5 * second_moment) - 1.0;
                assert!(error.abs() < 0.02, "{half:?}, {angle}, {direction}: {error}");
            }
        }
    }

    #[test]
    fn levers_turn_with_their_patch() {
        for angle in [0.3, 1.0, -2.5] {
            let (sine, cosine) = libm::sincos(angle);
            let (levers, offsets) = rectangle(HALF, 0.4);
            let turned = levers.turned([cosine, sine]);
            let (expected, expected_offsets) = rectangle(HALF, 0.4 + angle);
            let slip = Slip { velocity: [0.02, -0.05], spin: 3.0 };
            for (offset, expected_offset) in offsets.iter().zip(&expected_offsets) {
                let [x, y] = *offset;
                let at = turned.at(&slip).arms([cosine * x - sine * y, sine * x + cosine * y]);
                for (x, y) in at.iter().zip(expected.at(&slip).arms(*expected_offset)) {
                    assert!((x - y).abs() < 1e-12, "{angle}: {x} and {y}");
                }
            }
        }
    }

    #[test]
    fn a_pure_spin_meets_the_torsion_of_a_uniform_pressure() {
        // Mean distance of the points of a square from its centre, over half a side.
        let square = (libm::sqrt(2.0) + libm::asinh(1.0)) / 3.0;
        let (levers, offsets) = rectangle([0.03, 0.03], 0.3);
        for spin in [1e-6, 1e-3, 0.1, 10.0] {
            let slip = Slip { velocity: [0.0; 2], spin };
            let error = torque(&levers, &offsets, &slip) / (0.03 * square) - 1.0;
            assert!(error.abs() < 1e-6, "{spin}: {error}");
        }
    }

    #[test]
    fn levers_of_a_patch_that_sticks_do_not_depend_on_its_creep() {
        let (levers, offsets) = rectangle(HALF, 0.3);
        let still = levers.at(&Slip::default());
        let creeping = levers.at(&Slip { velocity: [2e-6, -1e-6], spin: 1e-5 });
        for offset in offsets {
            for (a, b) in still.arms(offset).into_iter().zip(creeping.arms(offset)) {
                assert!((a - b).abs() < 1e-9 * HALF[0], "{a} and {b}");
            }
        }
    }
}
