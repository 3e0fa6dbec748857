//! Views of the blocks that JavaScript reads from WebAssembly memory.

use glam::DVec3;
use teeter_dissertation::jenga3d::Jenga3D;
use teeter_dissertation::jenga3d::block::{CORNERS, SPRINGS};

use crate::fit;

/// Sizes and poses of all blocks.
#[derive(Debug)]
pub struct Views {
    /// Half edge lengths of each block, m.
    pub halves: Vec<DVec3>,
    /// Seven doubles a block: position (m) and orientation (x, y, z, w).
    pub poses: Vec<f64>,
    /// Indices in a block's springs of those between particles 0 and 1, 0 and 2, ... 6 and 7.
    order: [usize; SPRINGS],
}

impl Views {
    /// Creates the views of blocks with these half edge lengths, m.
    pub fn new(jenga: &Jenga3D, halves: Vec<DVec3>) -> Self {
        let ends: Vec<[u32; 2]> = jenga.model.springs[..SPRINGS].iter().map(|s| [s.p1, s.p2]).collect();
        let pairs = (0..CORNERS as u32).flat_map(|a| (a + 1..CORNERS as u32).map(move |b| [a, b]));
        let mut order = [0; SPRINGS];
        for (index, pair) in order.iter_mut().zip(pairs) {
            *index = ends.iter().position(|e| *e == pair).expect("a spring joins every two particles");
        }
        let mut views = Self { halves, poses: Vec::new(), order };
        views.update_poses(jenga);
        views
    }

    /// Fits a rigid pose to the particles of each block.
    pub fn update_poses(&mut self, jenga: &Jenga3D) {
        self.poses.clear();
        for (block, half) in jenga.model.blocks.iter().zip(&self.halves) {
            let first = block.corners().start;
            let corners = std::array::from_fn(|c| jenga.curr[first + c].position);
            let (centre, orientation) = fit::pose(&corners, *half);
            self.poses.extend(centre.to_array().into_iter().chain(orientation.to_array()));
        }
    }

    /// Writes the particles and springs of all blocks: 52 floats a block, positions of 8 particles
    /// (m) and forces of 28 springs (N).
    pub fn write_lattices(&self, jenga: &Jenga3D, lattices: &mut Vec<f32>) {
        let Jenga3D { model, curr, .. } = jenga;
        lattices.clear();
        for block in &model.blocks {
            lattices.extend(curr[block.corners()].iter().flat_map(|s| s.position.as_vec3().to_array()));
            let springs = &model.springs[block.springs as usize..][..SPRINGS];
            let tension = |n: &usize| springs[*n].stiffness * (springs[*n].length(curr) - springs[*n].rest_length);
            lattices.extend(self.order.iter().map(|n| tension(n) as f32));
        }
    }
}
