//! Colour of a surface: wood, light, shadow, sky and tone.

pub mod light;
pub mod noise;
pub mod occlusion;
pub mod shadow;
pub mod table;
pub mod tone;
pub mod wood;

use glam::Vec3;

/// Returns `a` at 0 and `b` at 1.
pub fn mix(a: f32, b: f32, t: f32) -> f32 {
    a * (1.0 - t) + b * t
}

/// Returns `a` at 0 and `b` at 1.
pub fn mix3(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a * (1.0 - t) + b * t
}

/// Hermite interpolation from 0 at `low` to 1 at `high`.
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Largest whole number that is not above x. Processors without an instruction for it call a
/// function for [`f32::floor`].
pub fn floor(x: f32) -> f32 {
    let whole = x as i32 as f32;
    if whole > x { whole - 1.0 } else { whole }
}

/// Fractional part, from 0 to 1.
pub fn fract(x: f32) -> f32 {
    x - floor(x)
}
