//! Pictures of towers: triangles drawn into a raster with depths, as PNG.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DVec2, DVec3};
use maud::{Markup, html};
use teeter_dissertation::jenga3d::block::{EDGE_CORNERS, FACE_CORNERS};
use teeter_dissertation::jenga3d::pick::Camera;

use super::tower::Tower;

/// Width and height of a picture, pixels.
const SIZE: (usize, usize) = (220, 260);
/// Samples along each side of a pixel, for smooth edges.
const SAMPLES: usize = 3;

/// Red, green and blue, 0 to 255.
type Colour = [f64; 3];

const WOOD: Colour = [222.0, 184.0, 125.0];
/// Colour of a disabled block, as in Figure 6.22.
const RED: Colour = [205.0, 62.0, 50.0];
const BACKGROUND: Colour = [246.0, 245.0, 242.0];
const FLOOR: Colour = [228.0, 226.0, 220.0];

/// Share of the distance by which edges are nearer than the faces that they bound, so that they are
/// visible.
const EDGE_OFFSET: f64 = 5e-4;

/// Blocks that are red.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Highlight {
    /// No block.
    None,
    /// Blocks that are disabled or asleep.
    Resting,
}

/// Returns a picture of a tower of a height (m) with its caption.
pub fn figure(tower: &Tower, height: f64, highlight: Highlight, caption: &str) -> Markup {
    let png = STANDARD.encode(png(&draw(tower, height, highlight)));
    html! {
        figure {
            img width=(SIZE.0) height=(SIZE.1) alt=(caption) src={ "data:image/png;base64," (png) };
            figcaption { (caption) }
        }
    }
}

/// Colours and depths of the samples of a picture.
struct Raster {
    camera: Camera,
    width: usize,
    height: usize,
    colours: Vec<Colour>,
    depths: Vec<f64>,
}

fn draw(tower: &Tower, height: f64, highlight: Highlight) -> Raster {
    let extent = height.max(0.1);
    let mut raster = Raster::new(Camera {
        target: DVec3::new(0.0, 0.0, 0.45 * height),
        distance: 8.0 * extent,
        azimuth: -0.67,
        elevation: 0.35,
        half_height: 0.12,
    });
    let corner = |x: f64, y: f64| DVec3::new(x * extent, y * extent, -1e-4);
    let floor = [corner(-0.7, -0.7), corner(0.7, -0.7), corner(0.7, 0.7), corner(-0.7, 0.7)];
    raster.triangle([floor[0], floor[1], floor[2]], FLOOR);
    raster.triangle([floor[2], floor[3], floor[0]], FLOOR);
    for block in 0..tower.len() {
        let is_red = highlight == Highlight::Resting && tower.is_resting(block);
        raster.block(&tower.corners(block), if is_red { RED } else { WOOD });
    }
    raster
}

impl Raster {
    fn new(camera: Camera) -> Self {
        let (width, height) = (SIZE.0 * SAMPLES, SIZE.1 * SAMPLES);
        let count = width * height;
        Self { camera, width, height, colours: vec![BACKGROUND; count], depths: vec![f64::INFINITY; count] }
    }

    /// Draws the faces and edges of a block.
    fn block(&mut self, corners: &[DVec3; 8], colour: Colour) {
        let light = DVec3::new(0.5, 0.3, 0.8).normalize();
        for face in FACE_CORNERS {
            let [a, b, c] = face.map(|corner| corners[corner]);
            let normal = (c - a).cross(b - a).normalize_or_zero();
            let shade = 0.62 + 0.38 * normal.dot(light).max(0.0);
            self.triangle([a, b, c], colour.map(|x| x * shade));
        }
        for [a, b] in EDGE_CORNERS {
            self.line(corners[a], corners[b], colour.map(|x| x * 0.4));
        }
    }

    /// Position of a point of the world in the raster, and its depth.
    fn project(&self, point: DVec3) -> DVec3 {
        let p = self.camera.project(point);
        let half = 0.5 * self.height as f64;
        DVec3::new(0.5 * self.width as f64 + half * p.x, half - half * p.y, p.z)
    }

    fn set(&mut self, (x, y): (usize, usize), depth: f64, colour: Colour) {
        let n = y * self.width + x;
        if depth < self.depths[n] {
            (self.depths[n], self.colours[n]) = (depth, colour);
        }
    }

    fn triangle(&mut self, corners: [DVec3; 3], colour: Colour) {
        let [a, b, c] = corners.map(|point| self.project(point));
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        if !area.is_normal() {
            return;
        }
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let range =
            |low: f64, high: f64, end: usize| low.floor().max(0.0) as usize..(high.ceil().max(0.0) as usize).min(end);
        for y in range(low.y, high.y, self.height) {
            for x in range(low.x, high.x, self.width) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |u: DVec3, v: DVec3| (u.truncate() - p).perp_dot(v.truncate() - p) / area;
                let (wa, wb, wc) = (share(b, c), share(c, a), share(a, b));
                if wa >= 0.0 && wb >= 0.0 && wc >= 0.0 {
                    // Under perspective the inverse of the depth is linear in the picture.
                    self.set((x, y), 1.0 / (wa / a.z + wb / b.z + wc / c.z), colour);
                }
            }
        }
    }

    fn line(&mut self, from: DVec3, to: DVec3, colour: Colour) {
        let (a, b) = (self.project(from), self.project(to));
        let steps = (2.0 * (b - a).truncate().length()).clamp(1.0, 1e4) as usize;
        for n in 0..=steps {
            let p = a.lerp(b, n as f64 / steps as f64);
            if p.x >= 0.0 && p.y >= 0.0 && (p.x as usize) < self.width && (p.y as usize) < self.height {
                self.set((p.x as usize, p.y as usize), p.z * (1.0 - EDGE_OFFSET), colour);
            }
        }
    }
}

/// Encodes a picture; each pixel is the mean of its samples.
fn png(raster: &Raster) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(SIZE.0 * SIZE.1 * 3);
    for y in 0..SIZE.1 {
        for x in 0..SIZE.0 {
            let sample = |n: usize| (y * SAMPLES + n / SAMPLES) * raster.width + x * SAMPLES + n % SAMPLES;
            let samples = (0..SAMPLES * SAMPLES).map(|n| DVec3::from(raster.colours[sample(n)]));
            let mean = samples.sum::<DVec3>() / (SAMPLES * SAMPLES) as f64;
            pixels.extend(mean.to_array().map(|c| c.clamp(0.0, 255.0) as u8));
        }
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE.0 as u32, SIZE.1 as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    written.expect("writing to memory does not fail");
    bytes
}
