//! Levers of friction: where the friction of a patch acts, and how far it turns on the spot.
//!
//! A patch under uniform pressure is divided into quarters, one for each corner. Friction of a
//! quarter acts at its lever, against sliding there and against its turning about itself; the three
//! components share one cone. A square divides into two by two squares, a long patch into four
//! strips in a row, so that the quarters stay compact. The levers are a linear map of the corners'
//! offsets from the centre of pressure, so the resultant acts there whatever the pressure is.

use serde::{Deserialize, Serialize};

/// Ratio of the sides from which a patch is divided into a row of four, and below which into two by
/// two.
const ROW_RATIO: (f64, f64) = (1.3, 2.5);
/// Levers over the offsets of the corners in a square.
const SQUARE: f64 = 0.462;
/// Change of the levers along the long side from a square to a row.
const ROW: f64 = 0.015;
/// Iterations that find the turning arm: each squares the relative error.
const TURN_ITERATIONS: usize = 4;

/// Levers of friction of a patch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionLevers {
    /// Lever over the offset from the centre of pressure, both along the two tangents.
    pub map: [[f64; 2]; 2],
    /// Arm of a quarter's own turning over the length of the offset.
    pub turn: f64,
}

impl FrictionLevers {
    /// Levers of a patch with corners at `offsets` from its centroid (m) that carry `shares` of the
    /// force. `torsion_ratio` is the torsional friction of its pressure over that of forces at the
    /// corners, which the levers reproduce exactly.
    pub fn new(offsets: &[[f64; 2]], shares: &[f64], torsion_ratio: f64) -> Self {
        let (ratio, axis) = principal_axis(offsets, shares);
        let [along, shear, across] = quarters(ratio);
        let [c, s] = axis;
        // Shear couples the two normalised axes: it leads from across to along.
        let shear = shear * ratio;
        let map = [
            [along * c * c - shear * c * s + across * s * s, along * c * s + shear * c * c - across * c * s],
            [along * c * s - shear * s * s - across * c * s, along * s * s + shear * c * s + across * c * c],
        ];
        let levers = Self { map, turn: 0.0 };
        let arms = offsets.iter().zip(shares).map(|(offset, share)| (levers.lever(*offset), length(*offset), *share));
        levers.with_torsion(arms.collect::<arrayvec::ArrayVec<_, 8>>().as_slice(), torsion_ratio)
    }

    /// Lever of a corner at `offset` from the centre of pressure, m.
    pub fn lever(&self, offset: [f64; 2]) -> [f64; 2] {
        self.map.map(|row| row[0] * offset[0] + row[1] * offset[1])
    }

    /// Arm of the own turning of the quarter at a corner, m.
    pub fn turning_arm(&self, offset: [f64; 2]) -> f64 {
        self.turn * length(offset)
    }

    /// Sets the turning arms so that the levers resist a pure spin as the pressure does. `arms` are
    /// lever (m), distance (m) and share of each corner.
    fn with_torsion(mut self, arms: &[([f64; 2], f64, f64)], torsion_ratio: f64) -> Self {
        let total: f64 = arms.iter().map(|(_, distance, share)| share * distance).sum();
        let target = torsion_ratio * total;
        let own: f64 = arms.iter().map(|(lever, _, share)| share * length(*lever)).sum();
        if total <= 0.0 {
            return Self { map: [[torsion_ratio, 0.0], [0.0, torsion_ratio]], turn: 0.0 };
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

/// Levers along the long side, their shear and levers across it, over the offsets of the corners of
/// a rectangle with this ratio of its sides.
///
/// They fit sliding and spinning at once to a fine mesh under uniform pressure, within 1 % in the
/// median and 5 % at most for ratios up to 4.
fn quarters(ratio: f64) -> [f64; 3] {
    let t = ((ratio - ROW_RATIO.0) / (ROW_RATIO.1 - ROW_RATIO.0)).clamp(0.0, 1.0);
    let row = t * t * (3.0 - 2.0 * t);
    // Logarithms over those of the ratios 4 and 2.
    let long = libm::log(ratio.clamp(1.0, 20.0));
    let along = SQUARE + ROW * row - 0.028 * (long - 1.386).max(0.0);
    [along, row * (0.207 + 0.03 * (long - 0.693).max(0.0)), SQUARE * (1.0 - row)]
}

/// Ratio of the extents of a patch along its principal axes, and the long one as a unit vector.
fn principal_axis(offsets: &[[f64; 2]], shares: &[f64]) -> (f64, [f64; 2]) {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for ([x, y], share) in offsets.iter().zip(shares) {
        xx += share * x * x;
        xy += share * x * y;
        yy += share * y * y;
    }
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
