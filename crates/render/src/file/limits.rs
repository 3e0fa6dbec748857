//! Sizes and frame rates of films.

/// Maximum frame rate of a GIF film, 1/s: viewers show no picture for less than two hundredths of a
/// second.
pub const GIF_FPS: f64 = 50.0;
/// Maximum lengths of the longer and the shorter side of an MP4 film, px.
pub const MP4_SIDES: (u32, u32) = (3840, 2160);
/// Minimum length of a side of an MP4 film, px.
pub const MIN_MP4_SIDE: u32 = 16;
