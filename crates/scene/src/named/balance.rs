//! Towers and planks in balance.

use glam::{DQuat, DVec3};

use super::setting::{nominal, scene_of};
use super::towers::exact;
use crate::preset::BlockPreset;
use crate::scene::{Block, Scene};

/// Share of the greatest possible overhangs in the tower of Lire. The blocks above an edge have
/// their centre of mass inside it by the rest of half a length, 0.81 mm.
const OVERHANG: f64 = 0.98;
/// Courses on each side of the arch, and the gap between the uppermost ones, m.
const ARCH_COURSES: u32 = 6;
const ARCH_GAP: f64 = 0.03;
/// Share of the greatest possible overhangs in the arch.
const ARCH_OVERHANG: f64 = 0.9;
/// Slope of the plate, degrees. With friction of 0.4 blocks slide from 21.8 degrees on.
const SLOPE: f64 = 15.0;

/// Ten blocks, each of which overhangs the one below by nearly 1/2, 1/4, 1/6, ... of its length,
/// from the top.
pub fn lire() -> Scene {
    let [length, _, height] = BlockPreset::Dissertation.size();
    let mut x = 0.0;
    let blocks = (0..10u32).map(|level| {
        if level > 0 {
            x += OVERHANG * length / (2.0 * f64::from(10 - level));
        }
        nominal(level, [x, 0.0, height * (f64::from(level) + 0.5)], 0.0)
    });
    scene_of(blocks.collect())
}

/// Two stacks of six blocks that lean towards each other, and one block across the gap between
/// them. Each course overhangs the one below as far as all above it balances, less a reserve.
pub fn arch() -> Scene {
    let [length, _, height] = BlockPreset::Dissertation.size();
    // Distances of the centres from the middle of the arch, from the top; the inner ends of the
    // uppermost courses bear half of the last block each.
    let mut centers = vec![0.5 * (ARCH_GAP + length)];
    let end = 0.5 * ARCH_GAP;
    for above in 1..ARCH_COURSES {
        let load = centers.iter().sum::<f64>() + 0.5 * end;
        centers.push(load / (f64::from(above) + 0.5) + 0.5 * ARCH_OVERHANG * length);
    }
    let course = |i: usize| height * (f64::from(ARCH_COURSES) - i as f64 - 0.5);
    let sides = [-1.0, 1.0].into_iter().flat_map(|side| {
        let leaf = centers.iter().enumerate().rev();
        leaf.map(move |(i, x)| [side * x, 0.0, course(i)])
    });
    let top = [0.0, 0.0, height * (f64::from(ARCH_COURSES) + 0.5)];
    scene_of(sides.chain([top]).zip(0..).map(|(position, id)| nominal(id, position, 0.0)).collect())
}

/// A plank on a fixed ridge of 4 mm, with one block at 120 mm on one side and two at 60 mm on the
/// other. All blocks lie across the plank.
pub fn see_saw() -> Scene {
    let [_, _, height] = BlockPreset::Dissertation.size();
    let (ridge, plank) = ([0.004, 0.09, 0.03], [0.3, 0.09, 0.01]);
    let top = ridge[2] + plank[2];
    let across = std::f64::consts::FRAC_PI_2;
    scene_of(vec![
        Block { fixed: true, ..Block::new(0, ridge, 0.1, [0.0, 0.0, 0.5 * ridge[2]]) },
        Block::new(1, plank, 0.14, [0.0, 0.0, ridge[2] + 0.5 * plank[2]]),
        nominal(2, [-0.12, 0.0, top + 0.5 * height], across),
        nominal(3, [0.06, 0.0, top + 0.5 * height], across),
        nominal(4, [0.06, 0.0, top + 1.5 * height], across),
    ])
}

/// Six full rows on a fixed plate that slopes along x. The plate stands on its lower edge.
pub fn slope() -> Scene {
    let plate = [0.3, 0.2, 0.02];
    let tower = exact("(111)-(111)-(111)-(111)-(111)-(111)");
    let (sin, cos) = libm::sincos(0.5 * f64::to_radians(SLOPE));
    let turn = DQuat::from_array([0.0, sin, 0.0, cos]);
    let (sin, cos) = libm::sincos(f64::to_radians(SLOPE));
    let lift = DVec3::Z * (0.5 * plate[0] * sin + 0.5 * plate[2] * cos);
    // The tower's own floor is the upper face of the plate.
    let on_plate = |pos: [f64; 3]| (turn * (DVec3::from_array(pos) + DVec3::Z * (0.5 * plate[2])) + lift).to_array();
    let base = Block {
        orientation: Some(turn.to_array()),
        fixed: true,
        ..Block::new(tower.blocks.len() as u32, plate, 1.0, lift.to_array())
    };
    let turned = |b: Block| Block {
        pos: on_plate(b.pos),
        orientation: Some((turn * DQuat::from_array(b.rotation())).to_array()),
        yaw: 0.0,
        ..b
    };
    let blocks = tower.blocks.into_iter().map(turned).chain([base]).collect();
    Scene { blocks, ..scene_of(Vec::new()) }
}
