//! Bounding volume hierarchy: finds the boxes that a ray may meet.

use glam::Vec3;

use crate::bounds::Bounds;
use crate::ray::Ray;

/// Maximum number of boxes in a leaf.
const LEAF: usize = 2;
/// Depth of the deepest tree: each level halves the number of boxes.
const MAX_DEPTH: usize = 32;

/// Binary tree of boxes, split at the median.
#[derive(Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// Indices of the boxes, in the order of the leaves.
    items: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// Index of the second child, or of the first item of a leaf. The first child follows its
    /// parent.
    index: u32,
    /// Number of items, 0 where this is no leaf.
    count: u32,
}

impl Bvh {
    /// Builds the tree.
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            let mut items = std::mem::take(&mut tree.items);
            tree.split(boxes, &mut items, 0);
            tree.items = items;
        }
        tree
    }

    fn split(&mut self, boxes: &[Bounds], items: &mut [u32], first: usize) {
        let bounds = |items: &[u32]| items.iter().fold(Bounds::EMPTY, |all, &i| all.union(boxes[i as usize]));
        let index = self.nodes.len();
        self.nodes.push(Node { bounds: bounds(items), index: first as u32, count: items.len() as u32 });
        if items.len() <= LEAF {
            return;
        }
        let centre = |i: u32| boxes[i as usize].centre();
        let spread = items.iter().fold(Bounds::EMPTY, |all, &i| all.union(Bounds { min: centre(i), max: centre(i) }));
        let axis = (spread.max - spread.min).max_position();
        let middle = items.len() / 2;
        // Ties by index, so that the tree does not depend on the order of the selection.
        items.select_nth_unstable_by(middle, |&a, &b| centre(a)[axis].total_cmp(&centre(b)[axis]).then(a.cmp(&b)));
        let (left, right) = items.split_at_mut(middle);
        self.split(boxes, left, first);
        self.nodes[index].index = self.nodes.len() as u32;
        self.nodes[index].count = 0;
        self.split(boxes, right, first + middle);
    }

    /// Bounds of all boxes.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, |root| root.bounds)
    }

    /// Calls `test` with the boxes that a ray may enter within `max`, roughly the nearest first. It
    /// returns the distance beyond which boxes no longer count; below 0 ends the search.
    pub fn visit(&self, ray: &Ray, mut max: f32, mut test: impl FnMut(u32, f32) -> f32) {
        let inv = inverse(ray.direction);
        let mut stack = [(0u32, 0.0f32); MAX_DEPTH];
        let mut depth = 0;
        let enter = |index: u32, max: f32| self.nodes[index as usize].bounds.entry(ray.origin, inv, max);
        if let Some(distance) = self.nodes.first().and_then(|_| enter(0, max)) {
            stack[0] = (0, distance);
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (index, distance) = stack[depth];
            if distance > max {
                continue;
            }
            let node = self.nodes[index as usize];
            if node.count > 0 {
                for &item in &self.items[node.index as usize..][..node.count as usize] {
                    max = test(item, max);
                    if max < 0.0 {
                        return;
                    }
                }
                continue;
            }
            let mut children = [index + 1, node.index].map(|child| (child, enter(child, max)));
            if children[0].1 < children[1].1 {
                children.swap(0, 1);
            }
            for (child, distance) in children {
                if let Some(distance) = distance {
                    stack[depth] = (child, distance);
                    depth += 1;
                }
            }
        }
    }
}

/// Returns one over a direction. Zeros count as tiny numbers, since zero times infinity is none.
fn inverse(direction: Vec3) -> Vec3 {
    Vec3::from_array(direction.to_array().map(|x| 1.0 / if x == 0.0 { 1e-30 } else { x }))
}
