//! From linear light to the colours of a screen.

use glam::Vec3;

/// Reflectance from which the tone curve compresses, and by how much it desaturates beyond.
const COMPRESSION: f32 = 0.8 - 0.04;
const DESATURATION: f32 = 0.15;

/// Neutral tone curve of the Khronos group: keeps hues, compresses highlights.
pub fn neutral(colour: Vec3) -> Vec3 {
    let low = colour.min_element();
    let offset = if low < 0.08 { low - 6.25 * low * low } else { 0.04 };
    let colour = colour - offset;
    let peak = colour.max_element();
    if peak < COMPRESSION {
        return colour;
    }
    let room = 1.0 - COMPRESSION;
    let compressed = 1.0 - room * room / (peak + room - COMPRESSION);
    let grey = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    super::mix3(colour * (compressed / peak), Vec3::splat(compressed), grey)
}

/// Returns linear light as sRGB, both from 0 to 1.
pub fn encode(linear: Vec3) -> Vec3 {
    let channel = |x: f32| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::powf(x, 1.0 / 2.4) - 0.055 };
    Vec3::from_array(linear.clamp(Vec3::ZERO, Vec3::ONE).to_array().map(channel))
}

/// Returns an sRGB colour, as eight bits a channel, as linear light.
pub fn decode(srgb: [u8; 3]) -> Vec3 {
    Vec3::from_array(srgb.map(|byte| {
        let x = f32::from(byte) / 255.0;
        if x <= 0.040_45 { x / 12.92 } else { libm::powf((x + 0.055) / 1.055, 2.4) }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_survives_decoding_and_encoding() {
        for byte in 0..=255u8 {
            let colour = [byte, 255 - byte, 128];
            let back = (encode(decode(colour)) * 255.0).round();
            assert_eq!(back.to_array(), colour.map(f32::from));
        }
    }

    #[test]
    fn the_tone_curve_is_continuous_and_stays_below_white() {
        let (below, above) = (neutral(Vec3::splat(COMPRESSION + 0.039)), neutral(Vec3::splat(COMPRESSION + 0.041)));
        assert!((above - below).length() < 0.01);
        assert!(neutral(Vec3::splat(100.0)).max_element() < 1.0);
        // Khronos' offset of a reflectance at normal incidence.
        assert!((neutral(Vec3::splat(0.5)).x - 0.46).abs() < 1e-6);
    }
}
