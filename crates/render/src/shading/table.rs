//! The table: a matt surface that fades into the background of the page.

use glam::{Vec2, Vec3, Vec3Swizzles};

use super::smoothstep;
use super::tone::decode;
use crate::bounds::Bounds;

/// Colours of the table, and of the background in its middle and at its edge.
const COLOUR: [u8; 3] = [0xde, 0xda, 0xd3];
const BACK: [[u8; 3]; 2] = [[0xef, 0xe9, 0xe0], [0xd6, 0xcc, 0xbe]];
/// Roughness of the table.
pub const ROUGHNESS: f32 = 0.95;
/// Radii at which the fade begins and ends, m.
const FADE: [f32; 2] = [0.3, 1.5];
/// Minimum distance from the blocks to the beginning of the fade, m. The default radii fit a tower.
const MARGIN: f32 = 0.2;

/// Table under the blocks.
#[derive(Debug, Clone, Copy)]
pub struct Table {
    /// Linear colour.
    colour: Vec3,
    centre: Vec2,
    /// Factor on the radii of the fade.
    scale: f32,
}

impl Table {
    /// Returns a table on which blocks with these bounds stand.
    pub fn new(bounds: Bounds) -> Self {
        let colour = decode(COLOUR);
        if !bounds.min.is_finite() {
            return Self { colour, centre: Vec2::ZERO, scale: 1.0 };
        }
        let radius = 0.5 * (bounds.max - bounds.min).xy().length();
        Self { colour, centre: bounds.centre().xy(), scale: ((radius + MARGIN) / FADE[0]).max(1.0) }
    }

    /// Linear colour.
    pub fn colour(&self) -> Vec3 {
        self.colour
    }

    /// Opacity of the table at a point of it.
    pub fn opacity(&self, point: Vec3) -> f32 {
        let radius = (point.xy() - self.centre).length() / self.scale;
        1.0 - smoothstep(FADE[0], FADE[1], radius)
    }
}

/// Background at a point of the picture, as sRGB from 0 to 1. `x` and `y` run from 0 to 1 to the
/// right and down.
pub fn background(x: f32, y: f32) -> Vec3 {
    let t = Vec2::new((x - 0.5) / 1.2, (y - 0.42) / 0.9).length().min(1.0);
    let [middle, edge] = BACK.map(|colour| Vec3::from_array(colour.map(|byte| f32::from(byte) / 255.0)));
    super::mix3(middle, edge, t)
}
