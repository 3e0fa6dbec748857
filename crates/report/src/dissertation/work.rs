//! What a frame costs, counted: floating-point operations, from how often each kind of work is done. A clock would measure the machine and what
//! else it does. Operations of each kind are read off the source, to one or two digits; comparisons, roots and divisions count as one.

use teeter_dissertation::jenga3d::block::{CORNERS, SPRINGS};
use teeter_dissertation::jenga3d::counters::{Counters, TESTS_OF_PAIR};
use teeter_dissertation::jenga3d::{Disabling, Jenga3D, Method};
use teeter_physics::{StepReport, World};

/// Operations a second of the core that a frame rate is reckoned for: one a cycle at 2 GHz, of the four and more that such cores do.
pub const CORE: f64 = 2e9;

/// A spring between two particles: elongation, its rate, and a force on both.
const SPRING: f64 = 35.0;
/// A particle that is stepped forward.
const PARTICLE: f64 = 20.0;
/// Two boxes compared.
const BOXES: f64 = 6.0;
/// Boxes of the parts of one block and the whole other: corners and faces both ways, and edges.
const PARTS: f64 = 64.0;
/// The cubic of a test, and whether it may vanish.
const CUBIC: f64 = 150.0;
/// Its roots, and the place at each.
const ROOTS: f64 = 300.0;
/// A collision resolved, and the boxes about what it moved.
const RESPONSE: f64 = 300.0;

/// Of a frame of the 2003 method in which these tests were made.
pub fn of_springs(simulator: &Jenga3D, tests: &Counters) -> f64 {
    let c = &simulator.constants;
    let forces = match c.method {
        Method::Euler => 1,
        Method::Midpoint => 2,
        Method::Rk4 => 4,
        Method::Multi => c.iterations_per_frame,
    };
    let moving = simulator.model.blocks.iter().filter(|b| b.active || c.disabling != Disabling::Rigid).count() as f64;
    let block = SPRINGS as f64 * SPRING + CORNERS as f64 * PARTICLE;
    let pairs = |tests: u64| tests as f64 / TESTS_OF_PAIR as f64;
    f64::from(c.mid_loop_count * forces) * moving * block
        + pairs(tests.potential) * BOXES
        + pairs(tests.after_blocks) * PARTS * BOXES
        + tests.after_boxes as f64 * (BOXES + CUBIC)
        + tests.after_planes as f64 * ROOTS
        + tests.collisions as f64 * RESPONSE
}

/// A contact of the engine in a substep: the motion of its patch, and the forces on both bodies.
const CONTACT: f64 = 140.0;
/// One of its points: a spring, a damper, a Maxwell element and friction.
const POINT: f64 = 45.0;
/// Points of a contact, where two faces meet.
const POINTS: f64 = 4.0;
/// A rigid body stepped forward.
const BODY: f64 = 60.0;
/// What a contact costs more where bodies are springs: from particles to the surface, and from there to particles.
const CONTACT_OF_SPRINGS: f64 = 200.0;
/// Detection on a pair.
const DETECTION: f64 = 3000.0;

/// Of a frame of the engine.
pub fn of_world(world: &World, report: &StepReport) -> f64 {
    let springs = world.spring_stiffness().is_some();
    let contact = CONTACT + POINTS * POINT + if springs { CONTACT_OF_SPRINGS } else { 0.0 };
    let body = if springs { SPRINGS as f64 * SPRING + CORNERS as f64 * PARTICLE } else { BODY };
    f64::from(report.substeps) * (f64::from(report.manifolds) * contact + f64::from(report.awake) * body)
        + f64::from(report.detections) * DETECTION
}
