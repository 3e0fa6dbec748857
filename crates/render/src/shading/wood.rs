//! The wood: light hardwood, cut from logs that differ from block to block.
//!
//! It is solid: its colour is a function of the position in the log, so that rings run round the
//! end of a block into the lines of its sides. Constants are those of the page's shader.

use core::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec3Swizzles};

use super::noise::{noise, random};
use super::{floor, fract, mix, mix3, smoothstep};

/// Linear colours of the wood that grows early and late in a year.
const EARLY: Vec3 = Vec3::new(0.760, 0.535, 0.325);
const LATE: Vec3 = Vec3::new(0.545, 0.325, 0.160);

/// Log that a block is cut from.
#[derive(Debug, Clone, Copy)]
pub struct Log {
    /// Four numbers from 0 to 1.
    seed: [f32; 4],
    /// Centre of the rings across the grain, m.
    pith: Vec2,
    /// Change of the position across the grain along it.
    slant: Vec2,
    /// Offset in the noise.
    shift: Vec3,
}

/// Colour and roughness of wood at a point.
#[derive(Debug, Clone, Copy)]
pub struct Wood {
    /// Linear colour.
    pub colour: Vec3,
    /// Roughness of its reflection.
    pub roughness: f32,
}

/// Point in the frame of a block, with its changes from a pixel to the next in both directions, m.
#[derive(Debug, Clone, Copy)]
pub struct Footprint {
    /// Point.
    pub point: Vec3,
    /// Change of the point to the right in the picture.
    pub right: Vec3,
    /// Change of the point downwards in the picture.
    pub down: Vec3,
}

impl Log {
    /// Returns the log of the block with an index.
    pub fn new(block: u32) -> Self {
        let seed = [0, 1, 2, 3].map(|salt| random(block, salt));
        let [x, y, z, w] = seed;
        let (sin, cos) = libm::sincosf(x * TAU);
        let pith = Vec2::new(cos, sin) * (0.018 + 0.06 * y);
        let slant = Vec2::new((z - 0.5) * 0.16, (w - 0.5) * 0.1);
        Self { seed, pith, slant, shift: 97.0 * Vec3::new(x, y, z) }
    }

    /// Position in the log, m: grain along x.
    fn position(&self, p: Vec3) -> Vec3 {
        let across = p.yz() + p.x * self.slant;
        Vec3::new(p.x, across.x, across.y)
    }

    /// Number of rings from the pith to a position in the log.
    fn rings(&self, q: Vec3) -> f32 {
        let wave = 0.0040 * noise(q * Vec3::new(14.0, 38.0, 38.0) + self.shift)
            + 0.0011 * noise(q * Vec3::new(40.0, 190.0, 190.0) + self.shift);
        ((q.yz() - self.pith).length() + wave) / mix(0.0019, 0.0032, self.seed[3])
    }

    /// Returns the wood at a point whose normal in the block's frame is `normal`.
    pub fn at(&self, footprint: &Footprint, normal: Vec3) -> Wood {
        let q = self.position(footprint.point);
        let (right, down) = (self.position(footprint.right), self.position(footprint.down));
        let rings = self.rings(q);
        let blur = (self.rings(q + right) - rings).abs() + (self.rings(q + down) - rings).abs();
        let phase = fract(rings);
        let late = smoothstep(0.25, 0.93, phase) * (1.0 - smoothstep(0.93, 1.0, phase));
        let late = mix(late, 0.36, smoothstep(0.25, 0.9, blur));
        let strength = 0.5 + 0.5 * noise(Vec3::new(floor(rings) * 1.7, q.x * 3.0, 0.5) + self.shift);

        // Fibres: long along the grain, fine across it; they fade before they would shimmer.
        let spread = 1500.0 * (right.abs() + down.abs());
        let grain = noise(q * Vec3::new(55.0, 1500.0, 1500.0) + self.shift) - 0.5;
        let grain = grain * (1.0 - smoothstep(0.35, 1.1, spread.y.max(spread.z)));
        let cloud = noise(q * Vec3::new(16.0, 70.0, 70.0) + self.shift.zxy()) - 0.5;

        let end = smoothstep(0.6, 0.9, normal.x.abs());
        let colour = mix3(EARLY, LATE, late * strength * mix(0.62, 0.85, end));
        let colour = colour * (1.0 + 0.16 * grain + 0.12 * cloud) * mix(1.0, 0.80, end) * self.tint();
        Wood { colour, roughness: 0.56 + 0.16 * late + 0.2 * end + 0.1 * grain }
    }

    /// Factor on the colour of the block: lighter or darker, more yellow or more red.
    fn tint(&self) -> Vec3 {
        let [x, y, z, w] = self.seed;
        let light = 0.86 + 0.26 * fract(y * 7.31 + z);
        let warm = fract(w * 5.77 + x) - 0.5;
        light * Vec3::new(1.0 + 0.05 * warm, 1.0, 1.0 - 0.16 * warm)
    }
}
