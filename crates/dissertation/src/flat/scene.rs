//! Scenes in the plane: upright sections through the scenes of space.

use glam::DVec2;
use teeter_scene::Scene;

/// A rectangle, its sides along the axes; x to the right, y up, the floor is y = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Full side lengths, m.
    pub size: DVec2,
    /// Mass, kg.
    pub mass: f64,
    /// Centre, m.
    pub centre: DVec2,
}

/// The blocks of a scene that its plane y = 0 cuts, as rectangles in that plane: of each row that lies along x the block nearest to the
/// plane, of one that lies along y all.
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

/// Rectangles of a block's length and height, one upon the other, `gap` (m) apart.
pub fn stack(count: u32, gap: f64) -> Vec<Rectangle> {
    let size = DVec2::new(0.081, 0.018);
    let centre = |n: u32| DVec2::new(0.0, (size.y + gap) * (f64::from(n) + 0.5) + 0.5 * gap);
    (0..count).map(|n| Rectangle { size, mass: 0.0196, centre: centre(n) }).collect()
}

/// The same with the rows `spacing` (m) apart, so that they fall onto each other. Springs need it: a point that begins exactly on an edge may
/// by rounding begin behind it, and what is behind is never seen to come through.
pub fn apart(blocks: &[Rectangle], spacing: f64) -> Vec<Rectangle> {
    let row = |b: &Rectangle| ((b.centre.y - 0.5 * b.size.y) / b.size.y).round();
    blocks.iter().map(|b| Rectangle { centre: b.centre + DVec2::new(0.0, spacing * (1.0 + row(b))), ..*b }).collect()
}
