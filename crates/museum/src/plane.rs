//! Binding of a prototype in the plane, with a pointer and the counters of its method.

mod options;
mod pointer;
#[cfg(test)]
mod tests;
mod world;

use glam::DVec2;
use serde::Serialize;
use teeter_dissertation::flat::constraint;
use teeter_dissertation::flat::manifold::Point;
use teeter_dissertation::flat::resting::Contact;
use teeter_dissertation::flat::scene::{Rectangle, stack};
use teeter_wasm_support::Error;
use wasm_bindgen::prelude::*;

use options::{MAX_BLOCKS, Method, Options};
use pointer::Pointer;
use world::World;

/// Maximum separation of blocks in contact, m.
const CONTACT_MARGIN: f64 = 5e-5;

/// Prototype in the plane.
///
/// ```
/// use teeter_museum::Plane;
///
/// let options = r#"{"method": "constraint", "setting": "stack", "count": 2}"#;
/// let mut plane = Plane::new(options).expect("valid options");
/// assert!(plane.hold(0.0, 0.009)); // the lower block
/// plane.drag(0.05, 0.009);
/// plane.advance(10);
/// assert_eq!(plane.held().len(), 4);
/// ```
#[wasm_bindgen]
#[derive(Debug)]
pub struct Plane {
    method: Method,
    world: World,
    /// Edge lengths of the blocks, m.
    sizes: Vec<DVec2>,
    /// Exported view of the corners, m.
    corners: Vec<f64>,
    time: f64,
    pointer: Option<Pointer>,
    counts: Counts,
}

/// Counters of the steps.
#[derive(Debug, Clone, Copy, Default, Serialize)]
struct Counts {
    /// Simulated time, s.
    time: f64,
    /// Pairs resolved, impulses, or rounds over the pairs, in the last step.
    iterations: u32,
    /// Maximum number of iterations in a step since the previous report.
    #[serde(rename = "most")]
    max_iterations: u32,
    /// Steps since the start that were cut short with pairs left.
    cut: u32,
    /// Steps since the start without forces for their resting contacts.
    unsolved: u32,
    /// Resting contact points of the constraint method; contact points of the others.
    points: usize,
    /// Tests of the last step: axes of rigid bodies, or points of springs against edges.
    tests: u64,
    /// Maximum penetration, m.
    overlap: f64,
}

#[wasm_bindgen]
impl Plane {
    /// Builds a scene from JSON: `{"method", "setting", "count", "gap", "stiffness"}`.
    ///
    /// The method is `springs`, `constraint`, `penalty` or `micro-collisions`, the setting `stack`,
    /// `falling` or `tower`. The gap is in m, the stiffness in N/m.
    ///
    /// # Errors
    /// Names the field that is missing, unknown or out of its range.
    #[wasm_bindgen(constructor)]
    pub fn new(options: &str) -> Result<Plane, Error> {
        let options = Options::from_json(options)?;
        let (world, sizes) = World::new(&options)?;
        let (method, counts) = (options.method, Counts::default());
        Ok(Self { method, world, sizes, corners: Vec::new(), time: 0.0, pointer: None, counts })
    }

    /// Time of a step, s.
    #[wasm_bindgen(getter)]
    pub fn step(&self) -> f64 {
        self.world.step_time()
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Number of blocks.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.sizes.len()
    }

    /// Advances by `steps` steps.
    pub fn advance(&mut self, steps: u32) {
        for _ in 0..steps {
            if let Some(pointer) = &self.pointer {
                pointer.pull(&mut self.world);
            }
            self.time += self.world.step_time();
            let step = self.world.step();
            self.counts.iterations = step.iterations;
            self.counts.cut += u32::from(step.cut);
            self.counts.unsolved += u32::from(step.unsolved);
            self.counts.tests = step.tests;
            self.counts.max_iterations = self.counts.max_iterations.max(step.iterations);
        }
    }

    /// Writes the corners of all blocks and returns their address in WebAssembly memory.
    ///
    /// Eight doubles a block, counter-clockwise from the lower left, x to the right and y upwards,
    /// m. Any later call may move them, so the view must be recreated.
    #[wasm_bindgen(js_name = cornersPtr)]
    pub fn corners_ptr(&mut self) -> *const f64 {
        self.corners.clear();
        self.corners.extend(self.world.corners().into_iter().flat_map(|corner| corner.to_array()));
        self.corners.as_ptr()
    }

    /// Contact points, five numbers each: position (m), unit normal, and normal force (N), 0 for a
    /// method without forces. Blocks of springs have none, because they only ever collide.
    pub fn contacts(&self) -> Vec<f64> {
        let World::Rigid(world) = &self.world else { return Vec::new() };
        let (contacts, forces) = match self.method {
            Method::Constraint => {
                let (contacts, forces) = constraint::resting(world);
                let zero = vec![0.0; contacts.len()];
                (contacts, forces.unwrap_or(zero))
            }
            _ => {
                let contacts = world.contacts(CONTACT_MARGIN);
                let force = |depth: f64| {
                    if self.method == Method::Penalty { world.constants.stiffness * depth.max(0.0) } else { 0.0 }
                };
                let forces = contacts.iter().map(|contact| force(contact.point.depth)).collect();
                (contacts, forces)
            }
        };
        let numbers = |(contact, force): (Contact, f64)| {
            let Point { position, normal, .. } = contact.point;
            [position.x, position.y, normal.x, normal.y, force]
        };
        contacts.into_iter().zip(forces).flat_map(numbers).collect()
    }

    /// Returns the counters of the steps as JSON, and resets the maximum number of iterations.
    ///
    /// # Errors
    /// When a number has no JSON.
    pub fn report(&mut self) -> Result<String, Error> {
        self.counts.time = self.time;
        if let World::Rigid(world) = &self.world {
            let contacts = world.contacts(CONTACT_MARGIN);
            self.counts.points = match self.method {
                Method::Constraint => constraint::resting(world).0.len(),
                _ => contacts.len(),
            };
            self.counts.overlap = contacts.iter().map(|contact| contact.point.depth).fold(0.0, f64::max);
        }
        let text = serde_json::to_string(&self.counts).map_err(|e| Error::json("report", e))?;
        self.counts.max_iterations = 0;
        Ok(text)
    }

    /// Adds a level block with its centre at (x, y) (m) and a velocity (m/s).
    ///
    /// # Errors
    /// When the scene is full or a number is not finite.
    pub fn add(&mut self, x: f64, y: f64, vx: f64, vy: f64) -> Result<(), Error> {
        if self.sizes.len() >= MAX_BLOCKS {
            return Err(Error::rejected(format!("there are {MAX_BLOCKS} blocks, no more fit")));
        }
        if ![x, y, vx, vy].iter().all(|v| v.is_finite()) {
            return Err(Error::rejected("a block needs a position and a velocity"));
        }
        let block = Rectangle { centre: DVec2::new(x, y), ..stack(1, 0.0)[0] };
        self.world.add(self.sizes.len(), &block, DVec2::new(vx, vy));
        self.sizes.push(block.size);
        Ok(())
    }

    /// Holds the block at a position (m), and returns true if there is one.
    pub fn hold(&mut self, x: f64, y: f64) -> bool {
        self.pointer = Pointer::take(&self.world, &self.sizes, DVec2::new(x, y));
        self.pointer.is_some()
    }

    /// Moves the pointer that holds a block to a position, m.
    pub fn drag(&mut self, x: f64, y: f64) {
        if let Some(pointer) = &mut self.pointer {
            pointer.target = DVec2::new(x, y);
        }
    }

    /// Releases the block.
    pub fn release(&mut self) {
        self.pointer = None;
    }

    /// Positions of the held point and the pointer, four numbers, m; empty while no block is held.
    pub fn held(&self) -> Vec<f64> {
        let Some(pointer) = &self.pointer else { return Vec::new() };
        let (point, target) = (pointer.held_point(&self.world), pointer.target);
        vec![point.x, point.y, target.x, target.y]
    }
}
