//! Cost of a frame in floating-point operations, from counts of each kind of work. A clock would
//! measure the machine and its other load. The operations of each kind are read off the source, to
//! one or two digits; comparisons, roots and divisions count as one.

use teeter_dissertation::jenga3d::block::{CORNERS, SPRINGS};
use teeter_dissertation::jenga3d::counters::{Counters, TESTS_OF_PAIR};
use teeter_dissertation::jenga3d::{Disabling, Jenga3D, Method};
use teeter_physics::{StepReport, World};

/// Spring between two particles: elongation, its rate, and a force on both.
const SPRING: f64 = 35.0;
/// Integration of a particle.
const PARTICLE: f64 = 20.0;
/// Comparison of two boxes.
const BOXES: f64 = 6.0;
/// Boxes of the parts of one block and the whole other: corners and faces in both orders, and
/// edges.
const PARTS: f64 = 64.0;
/// Coefficients of the cubic of a test, and whether it may vanish.
const CUBIC: f64 = 150.0;
/// Roots of the cubic, and the point at each.
const ROOTS: f64 = 300.0;
/// Collision response, and the boxes around the moved parts.
const RESPONSE: f64 = 300.0;

/// Operations of the forces on a block and of its integration, once.
pub fn of_block(springs: usize) -> f64 {
    springs as f64 * SPRING + CORNERS as f64 * PARTICLE
}

/// Operations of a frame of the 2003 method in which `tests` were made.
pub fn of_springs(simulator: &Jenga3D, tests: &Counters) -> f64 {
    let c = &simulator.constants;
    let forces = match c.method {
        Method::Euler => 1,
        Method::Midpoint => 2,
        Method::Rk4 => 4,
        Method::Multi => c.iterations_per_frame,
    };
    let moving = simulator.model.blocks.iter().filter(|b| b.active || c.disabling != Disabling::Rigid).count() as f64;
    let pairs = |tests: u64| tests as f64 / TESTS_OF_PAIR as f64;
    f64::from(c.mid_loop_count * forces) * moving * of_block(SPRINGS)
        + pairs(tests.potential) * BOXES
        + pairs(tests.after_blocks) * PARTS * BOXES
        + tests.after_boxes as f64 * (BOXES + CUBIC)
        + tests.after_planes as f64 * ROOTS
        + tests.collisions as f64 * RESPONSE
}

/// Contact of the engine in a substep: the motion of its patch, and the forces on both bodies.
const CONTACT: f64 = 140.0;
/// Point of a contact: a spring, a damper, a Maxwell element and friction.
const POINT: f64 = 45.0;
/// Points of a contact between two faces.
const POINTS: f64 = 4.0;
/// Integration of a rigid body.
const BODY: f64 = 60.0;
/// Additional cost of a contact between lattices: from particles to the surface, and back.
const CONTACT_OF_LATTICES: f64 = 200.0;
/// Collision detection on a pair.
const DETECTION: f64 = 3000.0;

/// Operations of a frame of the engine.
pub fn of_world(world: &World, report: &StepReport) -> f64 {
    let lattices = world.spring_stiffness().is_some();
    let contact = CONTACT + POINTS * POINT + if lattices { CONTACT_OF_LATTICES } else { 0.0 };
    let body = if lattices { of_block(SPRINGS) } else { BODY };
    f64::from(report.substeps) * (f64::from(report.manifolds) * contact + f64::from(report.awake) * body)
        + f64::from(report.detections) * DETECTION
}
