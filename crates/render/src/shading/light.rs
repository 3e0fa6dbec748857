//! Sun and sky of the page, and their reflection by a rough dielectric.

use core::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use super::tone::decode;
use super::{mix, mix3};

/// Direction of the sun, not of unit length: from the upper left of the default view.
const SUN_DIRECTION: Vec3 = Vec3::new(0.35, -1.0, 1.15);
/// Axis of the hemisphere of light, from its ground to its sky: y, as on the page, which leaves the
/// default of its library.
const SKY_AXIS: Vec3 = Vec3::Y;
const SUN: ([u8; 3], f32) = ([0xff, 0xf1, 0xdd], 2.9);
const SKY: ([u8; 3], f32) = ([0xf2, 0xf3, 0xf5], 1.5);
const GROUND: ([u8; 3], f32) = ([0xc2, 0xab, 0x90], 1.5);
/// Reflectance at normal incidence.
const F0: f32 = 0.04;
const MIN_ROUGHNESS: f32 = 0.045;

/// Lights of a picture.
#[derive(Debug, Clone, Copy)]
pub struct Lights {
    /// Unit vector to the sun.
    pub sun_direction: Vec3,
    sun: Vec3,
    sky: Vec3,
    ground: Vec3,
}

/// Surface that reflects light.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// Unit normal.
    pub normal: Vec3,
    /// Unit vector to the camera.
    pub view: Vec3,
    /// Linear colour of the diffuse reflection.
    pub colour: Vec3,
    /// Roughness of the specular reflection.
    pub roughness: f32,
}

/// Reflected light, linear.
#[derive(Debug, Clone, Copy)]
pub struct Reflection {
    /// Diffuse reflection of the sun.
    pub direct: Vec3,
    /// Specular reflection of the sun.
    pub specular: Vec3,
    /// Diffuse reflection of the sky.
    pub indirect: Vec3,
}

impl Lights {
    /// Lights of the page.
    pub fn new() -> Self {
        let light = |(colour, intensity)| intensity * decode(colour);
        let [sun, sky, ground] = [SUN, SKY, GROUND].map(light);
        Self { sun_direction: SUN_DIRECTION.normalize(), sun, sky, ground }
    }

    /// Returns the light that a surface reflects, with `sun` as the visible fraction of the sun.
    pub fn reflect(&self, surface: &Surface, sun: f32) -> Reflection {
        let roughness = surface.roughness.clamp(MIN_ROUGHNESS, 1.0);
        let fresnel = Fresnel::new(roughness, surface.normal.dot(surface.view).clamp(0.0, 1.0));
        let diffuse = FRAC_1_PI * surface.colour;
        let cos = surface.normal.dot(self.sun_direction).clamp(0.0, 1.0);
        let irradiance = (sun * cos) * self.sun;
        let half = (self.sun_direction + surface.view).normalize_or_zero();
        let schlick = schlick(surface.view.dot(half).clamp(0.0, 1.0));
        let lobe = schlick * lobe(roughness, surface, self.sun_direction, half) * fresnel.compensation;
        let height = 0.5 * surface.normal.dot(SKY_AXIS) + 0.5;
        Reflection {
            direct: (1.0 - schlick) * irradiance * diffuse,
            specular: lobe * irradiance,
            indirect: (1.0 - fresnel.reflected) * mix3(self.ground, self.sky, height) * diffuse,
        }
    }
}

/// Fresnel reflectance of the half vector, after Schlick.
fn schlick(cos: f32) -> f32 {
    let grazing = libm::exp2f((-5.554_73 * cos - 6.983_16) * cos);
    mix(F0, 1.0, grazing)
}

/// Specular lobe without the Fresnel term: the distribution of Trowbridge and Reitz with the
/// correlated visibility of Smith.
fn lobe(roughness: f32, surface: &Surface, light: Vec3, half: Vec3) -> f32 {
    let cos = |a: Vec3, b: Vec3| a.dot(b).clamp(0.0, 1.0);
    let (l, v, h) = (cos(surface.normal, light), cos(surface.normal, surface.view), cos(surface.normal, half));
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let gv = l * (a2 + (1.0 - a2) * v * v).sqrt();
    let gl = v * (a2 + (1.0 - a2) * l * l).sqrt();
    let visibility = 0.5 / (gv + gl).max(1e-6);
    let denominator = h * h * (a2 - 1.0) + 1.0;
    visibility * a2 / (PI * denominator * denominator)
}

/// Light that the specular layer reflects from all directions, by the fit of Karis.
struct Fresnel {
    /// Fraction reflected; the diffuse layer gets the rest.
    reflected: f32,
    /// Factor on the specular lobe for light reflected more than once.
    compensation: f32,
}

impl Fresnel {
    fn new(roughness: f32, cos: f32) -> Self {
        let r = [-1.0, -0.0275, -0.572, 0.022].map(|x| x * roughness);
        let r = [r[0] + 1.0, r[1] + 0.0425, r[2] + 1.04, r[3] - 0.04];
        let a = (r[0] * r[0]).min(libm::exp2f(-9.28 * cos)) * r[0] + r[1];
        let (scale, bias) = (-1.04 * a + r[2], 1.04 * a + r[3]);
        let (single, all) = (F0 * scale + bias, scale + bias);
        let mean = F0 + (1.0 - F0) / 21.0;
        let multiple = single * mean / (1.0 - (1.0 - all) * mean) * (1.0 - all);
        Self { reflected: single + multiple, compensation: 1.0 + F0 * (1.0 / all - 1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(normal: Vec3) -> Surface {
        Surface { normal, view: normal, colour: Vec3::splat(0.5), roughness: 1.0 }
    }

    /// Lambert: the light of a matt surface falls with the cosine of the sun's angle.
    #[test]
    fn direct_light_is_in_proportion_to_the_cosine() {
        let lights = Lights::new();
        let towards = lights.reflect(&surface(lights.sun_direction), 1.0).direct;
        let side = lights.sun_direction.any_orthonormal_vector();
        let oblique = (0.6 * lights.sun_direction + 0.8 * side).normalize();
        let tilted = lights.reflect(&Surface { view: lights.sun_direction, ..surface(oblique) }, 1.0).direct;
        assert!((tilted / towards).abs_diff_eq(Vec3::splat(0.6), 1e-4), "{}", tilted / towards);
        assert_eq!(lights.reflect(&surface(-lights.sun_direction), 1.0).direct, Vec3::ZERO);
    }

    /// A white surface reflects no more than it receives.
    #[test]
    fn the_sky_gives_a_matt_surface_no_more_than_it_sends() {
        let lights = Lights::new();
        for normal in [Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::Z] {
            let white = Surface { colour: Vec3::ONE, ..surface(normal) };
            let indirect = lights.reflect(&white, 0.0).indirect;
            assert!((PI * indirect).cmple(lights.sky).all() && indirect.min_element() > 0.1);
        }
    }
}
