//! Pictures of towers: triangles into a raster with depths, as PNG.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
use teeter_dissertation::jenga3d::block::{EDGE_CORNERS, FACE_CORNERS};
use teeter_dissertation::jenga3d::pick::Camera;

use super::column::Tower;

/// Size of a picture, pixels.
const SIZE: (usize, usize) = (220, 260);
/// Rays across a pixel, for smooth edges.
const FINE: usize = 3;

/// Red, green, blue, 0 to 255.
type Colour = [f64; 3];

/// Of wood.
const WOOD: Colour = [222.0, 184.0, 125.0];
/// Of a disabled block, as in Figure 6.22.
const RED: Colour = [205.0, 62.0, 50.0];
const BACKGROUND: Colour = [246.0, 245.0, 242.0];
const FLOOR: Colour = [228.0, 226.0, 220.0];

/// A tower as an `img` element; `height` (m) is that of what it shows, and blocks at rest are red where `mark_rest`.
pub fn of(tower: &dyn Tower, height: f64, mark_rest: bool, caption: &str) -> String {
    let png = STANDARD.encode(png(&draw(tower, height, mark_rest)));
    format!(
        "<figure><img width=\"{}\" height=\"{}\" alt=\"{caption}\" src=\"data:image/png;base64,{png}\"><figcaption>{caption}</figcaption></figure>",
        SIZE.0, SIZE.1
    )
}

struct Raster {
    width: usize,
    height: usize,
    colours: Vec<Colour>,
    depths: Vec<f64>,
}

fn draw(tower: &dyn Tower, height: f64, mark_rest: bool) -> Raster {
    let (width, tall) = (SIZE.0 * FINE, SIZE.1 * FINE);
    let mut raster = Raster {
        width,
        height: tall,
        colours: vec![BACKGROUND; width * tall],
        depths: vec![f64::INFINITY; width * tall],
    };
    let reach = height.max(0.1);
    let camera = Camera {
        target: DVec3::new(0.0, 0.0, 0.45 * height),
        distance: 8.0 * reach,
        azimuth: -0.67,
        elevation: 0.35,
        half_height: 0.12,
    };
    let corner = |x: f64, y: f64| DVec3::new(x * reach, y * reach, -1e-4);
    let floor = [corner(-0.7, -0.7), corner(0.7, -0.7), corner(0.7, 0.7), corner(-0.7, 0.7)];
    raster.triangle(&camera, [floor[0], floor[1], floor[2]], FLOOR);
    raster.triangle(&camera, [floor[2], floor[3], floor[0]], FLOOR);
    let light = DVec3::new(0.5, 0.3, 0.8).normalize();
    for block in 0..tower.len() {
        let corners = tower.corners(block);
        let base = if mark_rest && tower.rests(block) { RED } else { WOOD };
        for [a, b, c] in FACE_CORNERS {
            let [a, b, c] = [corners[a], corners[b], corners[c]];
            let out = (c - a).cross(b - a).normalize_or_zero();
            let shade = 0.62 + 0.38 * out.dot(light).max(0.0);
            raster.triangle(&camera, [a, b, c], base.map(|x| x * shade));
        }
        for [a, b] in EDGE_CORNERS {
            raster.line(&camera, corners[a], corners[b], base.map(|x| x * 0.4));
        }
    }
    raster
}

impl Raster {
    /// Where a point of the world is in the raster, and its depth.
    fn place(&self, camera: &Camera, point: DVec3) -> DVec3 {
        let p = camera.project(point);
        let half = 0.5 * self.height as f64;
        DVec3::new(0.5 * self.width as f64 + half * p.x, half - half * p.y, p.z)
    }

    fn set(&mut self, x: usize, y: usize, depth: f64, colour: Colour) {
        let n = y * self.width + x;
        if depth < self.depths[n] {
            (self.depths[n], self.colours[n]) = (depth, colour);
        }
    }

    fn triangle(&mut self, camera: &Camera, corners: [DVec3; 3], colour: Colour) {
        let [a, b, c] = corners.map(|p| self.place(camera, p));
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        if !area.is_normal() {
            return;
        }
        let range =
            |low: f64, high: f64, most: usize| low.floor().max(0.0) as usize..(high.ceil().max(0.0) as usize).min(most);
        let (xs, ys) = (
            range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.width),
            range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.height),
        );
        for y in ys {
            for x in xs.clone() {
                let p = glam::DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |u: DVec3, v: DVec3| (u.truncate() - p).perp_dot(v.truncate() - p) / area;
                let (wa, wb, wc) = (share(b, c), share(c, a), share(a, b));
                if wa >= 0.0 && wb >= 0.0 && wc >= 0.0 {
                    // In perspective inverse depths are what is linear in the picture.
                    self.set(x, y, 1.0 / (wa / a.z + wb / b.z + wc / c.z), colour);
                }
            }
        }
    }

    fn line(&mut self, camera: &Camera, from: DVec3, to: DVec3, colour: Colour) {
        let (a, b) = (self.place(camera, from), self.place(camera, to));
        let steps = (2.0 * (b - a).truncate().length()).clamp(1.0, 1e4) as usize;
        for n in 0..=steps {
            let p = a.lerp(b, n as f64 / steps as f64);
            // A little nearer than the faces that it bounds.
            if p.x >= 0.0 && p.y >= 0.0 && (p.x as usize) < self.width && (p.y as usize) < self.height {
                self.set(p.x as usize, p.y as usize, p.z * 0.9995, colour);
            }
        }
    }
}

/// The picture, each pixel the mean of its rays.
fn png(raster: &Raster) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(SIZE.0 * SIZE.1 * 3);
    for y in 0..SIZE.1 {
        for x in 0..SIZE.0 {
            let rays =
                (0..FINE * FINE).map(|n| raster.colours[(y * FINE + n / FINE) * raster.width + x * FINE + n % FINE]);
            let sum = rays.fold([0.0; 3], |sum, ray| [sum[0] + ray[0], sum[1] + ray[1], sum[2] + ray[2]]);
            pixels.extend(sum.map(|c| (c / (FINE * FINE) as f64).clamp(0.0, 255.0) as u8));
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
