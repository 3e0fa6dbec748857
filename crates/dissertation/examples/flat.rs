//! Stacks in the plane by every method.

use teeter_dissertation::flat::{rigid, scene, springs, *};

fn main() {
    for n in [1, 2, 3, 5, 8] {
        let blocks = scene::stack(n, 1e-3);
        for method in Method::ALL {
            for e in [0.0, 0.3] {
                let c = rigid::Constants { restitution: e, ..rigid::Constants::of(method) };
                let mut w = Rigid2D::new(&blocks, c);
                let (mut most, mut total, mut capped, mut failed) = (0, 0u64, 0, 0);
                let steps = (2.0 / c.step) as u32;
                for _ in 0..steps {
                    let r = w.step();
                    most = most.max(r.iterations);
                    total += r.iterations as u64;
                    capped += u32::from(r.capped);
                    failed += u32::from(r.failure.is_some());
                }
                let top = w.pose(n as usize - 1);
                println!(
                    "{n} {} e {e}: most {most} mean {:.2} capped {capped} failed {failed} top {:.3} mm expected {} aside {:.3} turn {:.4} v {:.4}",
                    method.name(),
                    total as f64 / steps as f64,
                    1e3 * top.0.y,
                    n as f64 * 18.0 - 9.0,
                    1e3 * top.0.x,
                    top.1,
                    w.bodies[n as usize].velocity.length()
                );
            }
        }
        let mut s = Springs2D::new(&blocks, springs::Constants::default());
        let (mut most, mut total, mut un) = (0, 0u64, 0);
        for _ in 0..8000 {
            let r = s.step();
            most = most.max(r.sweeps);
            total += r.sweeps as u64;
            un += u32::from(r.unresolved);
        }
        let top = s.pose(n as usize - 1);
        println!(
            "{n} springs: most {most} mean {:.2} unresolved {un} top {:.3} aside {:.3} turn {:.4}",
            total as f64 / 8000.0,
            1e3 * top.0.y,
            1e3 * top.0.x,
            top.1
        );
    }
}
