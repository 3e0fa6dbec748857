//! Value noise in space, and pseudo-random numbers, as in the shaders of the page.

use glam::{Vec3, Vec3Swizzles};

use super::{floor, fract, mix};

/// Pseudo-random number from 0 to 1 at a point of the lattice of whole numbers.
fn hash(point: Vec3) -> f32 {
    let mut p = (point * 0.1031).map(fract);
    p += Vec3::splat(p.dot(p.zyx() + 31.32));
    fract((p.x + p.y) * p.z)
}

/// Smooth noise from 0 to 1, with features of length 1.
pub fn noise(p: Vec3) -> f32 {
    let i = p.map(floor);
    let f = p - i;
    let f = f * f * (3.0 - 2.0 * f);
    let at = |x: f32, y: f32, z: f32| hash(i + Vec3::new(x, y, z));
    let row = |y: f32, z: f32| mix(at(0.0, y, z), at(1.0, y, z), f.x);
    mix(mix(row(0.0, 0.0), row(1.0, 0.0), f.y), mix(row(0.0, 1.0), row(1.0, 1.0), f.y), f.z)
}

/// Pseudo-random number from 0 to 1 for a block.
pub fn random(block: u32, salt: u32) -> f32 {
    let mut h = block.wrapping_add(1).wrapping_mul(0x9e37_79b1) ^ salt.wrapping_add(1).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (f64::from(h ^ (h >> 15)) / 4_294_967_296.0) as f32
}
