//! Pictures of blocks with known projections and shadows.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;
use rayon::ThreadPoolBuilder;
use teeter_render::{Camera, Picture, Renderer, Size, View, poses};
use teeter_scene::{Block, Scene, TowerOptions, named, tower};

const SIZE: Size = Size { width: 300, height: 200 };
/// Direction to the sun, as on the page.
const SUN: Vec3 = Vec3::new(0.35, -1.0, 1.15);

/// A scene of cubes with an edge, m, at these positions.
fn cubes(edge: f64, positions: &[[f64; 3]]) -> Scene {
    let blocks = positions.iter().enumerate().map(|(i, &pos)| Block::new(i as u32, [edge; 3], 0.02, pos)).collect();
    Scene { edge_radius: 0.0, blocks, ..tower(&TowerOptions::default()).unwrap() }
}

fn draw(scene: &Scene, camera: &Camera) -> Picture {
    Renderer::new(scene).draw(&poses(scene), camera, SIZE)
}

fn is_wood([red, green, blue]: [u8; 3]) -> bool {
    // Table and background are lighter or greyer than any wood.
    i32::from(red) - i32::from(blue) > 45 && i32::from(green) < 190
}

fn brightness(picture: &Picture, (x, y): (f32, f32)) -> u32 {
    picture.pixel(x as u32, y as u32).iter().map(|&channel| u32::from(channel)).sum()
}

/// A camera level with a cube sees its near face as a square: half the picture's height is the
/// tangent of 17 degrees at a distance of 1.
#[test]
fn a_cube_covers_the_pixels_of_its_projection() {
    let (edge, distance) = (0.1f32, 0.8f32);
    let scene = cubes(f64::from(edge), &[[0.0, 0.0, 0.05]]);
    let target = Vec3::new(0.0, 0.0, 0.05);
    let picture = draw(&scene, &Camera { azimuth: -FRAC_PI_2, elevation: 0.0, distance, target });
    let pixels = 100.0 / libm::tanf(17f32.to_radians());
    let half = 0.5 * edge * pixels / (distance - 0.5 * edge);
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 1.0), (-1.0, -1.0)] {
        let at = |offset: f32| {
            let (px, py) = (150.0 + x * (half + offset), 100.0 + y * (half + offset));
            is_wood(picture.pixel(px as u32, py as u32))
        };
        // A corner is chamfered by a pixel.
        assert!(at(-3.0), "inside at {x}, {y}");
        assert!(!at(2.0), "outside at {x}, {y}");
    }
}

/// The nearer of two blocks covers the farther.
#[test]
fn the_nearer_block_hides_the_farther_one() {
    let camera = Camera { azimuth: -FRAC_PI_2, elevation: 0.3, distance: 0.8, target: Vec3::new(0.0, 0.0, 0.05) };
    let near = [0.0, -0.2, 0.05];
    let both = draw(&cubes(0.1, &[near, [0.0, 0.2, 0.05]]), &camera);
    let alone = draw(&cubes(0.1, &[near]), &camera);
    let lens = camera.lens(SIZE);
    let (x, y) = lens.project(Vec3::new(0.0, -0.25, 0.05)).unwrap();
    assert_eq!(both.pixel(x as u32, y as u32), alone.pixel(x as u32, y as u32));
    // The top of the farther one is visible above it.
    let (x, y) = lens.project(Vec3::new(0.0, 0.2, 0.1)).unwrap();
    assert!(is_wood(both.pixel(x as u32, y as u32)) && !is_wood(alone.pixel(x as u32, y as u32)));
}

/// A corner of a cube that hangs at a height casts its shadow at the height over the slope of the
/// sun, on the side away from it. The shadow is dark on its inner side and light on its outer side,
/// beyond the half shadow of the sun's disc.
#[test]
fn the_shadow_of_a_corner_falls_where_the_sun_casts_it() {
    let (edge, height) = (0.06f32, 0.1f32);
    let scene = cubes(f64::from(edge), &[[0.0, 0.0, f64::from(height + 0.5 * edge)]]);
    let camera = Camera { azimuth: 1.2, elevation: 1.0, distance: 0.8, target: Vec3::new(0.0, 0.1, 0.0) };
    let (lit, bare) = (draw(&scene, &camera), draw(&cubes(0.001, &[[0.0, 0.0, 0.3]]), &camera));
    let lens = camera.lens(SIZE);
    let cast = |corner: Vec3| corner - SUN * (corner.z / SUN.z);
    let ratio = |point: Vec3| {
        let pixel = lens.project(point).unwrap();
        brightness(&lit, pixel) as f32 / brightness(&bare, pixel) as f32
    };
    let half = 0.5 * edge;
    // The lower corner furthest to the sun's left and right, and the middle of the underside.
    let middle = cast(Vec3::new(0.0, 0.0, height));
    assert!(ratio(middle) < 0.75, "{}", ratio(middle));
    for corner in [Vec3::new(-half, half, height + edge), Vec3::new(half, -half, height)] {
        let outward = (cast(corner) - middle).normalize();
        // Half shadow: the distance to the table times the sun's radius, over its height's sine.
        let sine = SUN.normalize().z;
        let soft = 0.0425 * corner.z / (sine * sine);
        let (inner, outer) = (cast(corner) - (soft + 0.008) * outward, cast(corner) + (soft + 0.008) * outward);
        assert!(ratio(inner) < 0.8 && ratio(outer) > 0.95, "{corner}: {} {}", ratio(inner), ratio(outer));
    }
}

/// Far from its caster a shadow is softer than near it.
#[test]
fn a_shadow_is_softer_far_from_its_caster() {
    let width = |height: f64| {
        let scene = cubes(0.1, &[[0.0, 0.0, height + 0.05]]);
        let camera = Camera { azimuth: 1.2, elevation: 1.2, distance: 1.0, target: Vec3::new(0.0, 0.0, 0.0) };
        let (picture, lens) = (draw(&scene, &camera), camera.lens(SIZE));
        // Across the shadow of the lower edge towards the sun.
        let foot = Vec3::new(0.0, -0.05, height as f32);
        let edge = foot - SUN * (foot.z / SUN.z);
        let profile: Vec<u32> = (-60..60)
            .map(|k| brightness(&picture, lens.project(edge + Vec3::new(0.0, 0.0005 * k as f32, 0.0)).unwrap()))
            .collect();
        let (dark, light) = (*profile.iter().min().unwrap(), *profile.iter().max().unwrap());
        let between = |x: &&u32| (dark + (light - dark) / 5..light - (light - dark) / 5).contains(x);
        profile.iter().filter(between).count()
    };
    let (near, far) = (width(0.03), width(0.3));
    assert!(far > 2 * near, "{near} {far}");
}

#[test]
fn the_picture_has_the_same_bytes_in_any_number_of_threads() {
    let scene = named("cards").unwrap();
    let renderer = Renderer::new(&scene);
    let camera = renderer.camera(&View::default(), &poses(&scene), SIZE);
    let in_threads = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| renderer.draw(&poses(&scene), &camera, SIZE))
    };
    let one = in_threads(1);
    assert_eq!(one, in_threads(2));
    assert_eq!(one, in_threads(7));
}

/// Every corner of a wide scene is in the picture, and the default view of a tower is the page's.
#[test]
fn the_default_view_frames_all_blocks() {
    for name in ["tower", "field", "wall", "dominoes", "cards", "lire"] {
        let scene = named(name).unwrap();
        let renderer = Renderer::new(&scene);
        for size in [SIZE, Size { width: 100, height: 300 }] {
            let camera = renderer.camera(&View::default(), &poses(&scene), size);
            let lens = camera.lens(size);
            for pose in poses(&scene) {
                let (x, y) = lens.project(pose.pose.position.as_vec3()).unwrap();
                assert!(x > 0.0 && x < size.width as f32 && y > 0.0 && y < size.height as f32, "{name}: {x}, {y}");
            }
        }
    }
    let tower = named("tower").unwrap();
    let camera = Renderer::new(&tower).camera(&View::default(), &poses(&tower), Size { width: 1280, height: 720 });
    // Read from the page.
    let page = Vec3::new(0.476_71, -0.666_63, 0.476_13);
    assert!(camera.position().distance(page) < 2e-3, "{}", camera.position());
}

/// Single precision places a block at 900 m to a sixteenth of a millimetre, and its picture shows
/// nothing of that.
#[test]
fn a_scene_far_from_the_origin_has_the_picture_of_a_near_one() {
    let near = named("test-6").unwrap();
    let mut far = near.clone();
    far.blocks.iter_mut().for_each(|block| {
        block.pos[0] += 900.0;
        block.pos[1] -= 700.0;
    });
    let [near, far] = [near, far].map(|scene| {
        let renderer = Renderer::new(&scene);
        let camera = renderer.camera(&View::default(), &poses(&scene), SIZE);
        renderer.draw(&poses(&scene), &camera, SIZE)
    });
    let differ = near.rgb.iter().zip(&far.rgb).filter(|(a, b)| a.abs_diff(**b) > 25).count();
    assert!(differ < near.rgb.len() / 200, "{differ}");
}

#[test]
fn a_scene_without_blocks_is_a_table() {
    let scene = cubes(0.1, &[]);
    let renderer = Renderer::new(&scene);
    let camera = renderer.camera(&View::default(), &[], SIZE);
    let picture = renderer.draw(&[], &camera, SIZE);
    assert!(!picture.rgb.chunks_exact(3).any(|rgb| is_wood([rgb[0], rgb[1], rgb[2]])));
}
