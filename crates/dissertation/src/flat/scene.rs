//! Scenes in the plane: upright sections through three-dimensional scenes.

use glam::DVec2;
use teeter_scene::Scene;

/// Axis-aligned rectangle; x is to the right, y upwards, and the floor is y = 0.
///
/// ```
/// use teeter_dissertation::flat::scene::section;
///
/// let scene = teeter_scene::named("column").expect("the list has it");
/// let rectangles = section(&scene);
/// assert_eq!((rectangles.len(), rectangles[0].size), (10, glam::DVec2::new(0.081, 0.018)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Full side lengths, m.
    pub size: DVec2,
    /// Mass, kg.
    pub mass: f64,
    /// Position of the centre, m.
    pub centre: DVec2,
}

/// Returns the section of a scene by its plane y = 0: the block nearest to the plane of each row
/// along x, and all blocks of each row along y.
pub fn section(scene: &Scene) -> Vec<Rectangle> {
    let mut cut: Vec<Rectangle> = Vec::new();
    for block in &scene.blocks {
        let along_x = libm::cos(block.yaw).abs() > 0.5;
        let [length, width, height] = block.size;
        let nearest = |other: &teeter_scene::Block| {
            let same_row = (other.pos[2] - block.pos[2]).abs() < 0.5 * height && libm::cos(other.yaw).abs() > 0.5;
            !same_row || (block.pos[1].abs(), block.id) <= (other.pos[1].abs(), other.id)
        };
        if along_x && !scene.blocks.iter().all(nearest) {
            continue;
        }
        let size = DVec2::new(if along_x { length } else { width }, height);
        cut.push(Rectangle { size, mass: block.mass, centre: DVec2::new(block.pos[0], block.pos[2]) });
    }
    cut
}

/// Returns a stack of rectangles of a block's length and height, `gap` (m) apart.
pub fn stack(count: u32, gap: f64) -> Vec<Rectangle> {
    let size = DVec2::new(0.081, 0.018);
    let centre = |n: u32| DVec2::new(0.0, (size.y + gap) * (f64::from(n) + 0.5) + 0.5 * gap);
    (0..count).map(|n| Rectangle { size, mass: 0.0196, centre: centre(n) }).collect()
}

/// Returns the rectangles with the rows `spacing` (m) apart, so that they fall onto each other.
///
/// Springs need the spacing: a point exactly on an edge may start behind it by rounding, and
/// detection finds only points that pass from the front.
pub fn apart(blocks: &[Rectangle], spacing: f64) -> Vec<Rectangle> {
    let row = |b: &Rectangle| ((b.centre.y - 0.5 * b.size.y) / b.size.y).round();
    blocks.iter().map(|b| Rectangle { centre: b.centre + DVec2::new(0.0, spacing * (1.0 + row(b))), ..*b }).collect()
}
