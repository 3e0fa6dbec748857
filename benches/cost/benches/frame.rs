//! Time of a frame of each workload, by criterion, which compares it with the previous run. Each
//! workload is printed with the hash of its final state.

use std::time::Duration;

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use teeter_cost::{Clocked, CostError, Workload, one_thread};
use teeter_physics::Precision::{Double, Single};

fn workloads() -> Result<Vec<Workload>, CostError> {
    Ok(vec![
        Workload::awake(18, 1e6, Single)?.of_frames(10),
        Workload::awake(18, 3e5, Single)?.of_frames(10),
        Workload::awake(18, 3e6, Single)?.of_frames(10),
        Workload::awake(18, 1e6, Double)?.of_frames(10),
        Workload::springs()?.of_frames(10),
        Workload::awake(6, 1e6, Single)?.of_frames(10),
        Workload::swaying()?.of_frames(10),
        Workload::asleep()?.of_frames(60),
        Workload::golden("pull", 60)?,
        Workload::golden("collapse", 60)?,
    ])
}

fn bench(c: &mut Criterion) {
    one_thread().expect("the global thread pool does not exist yet");
    let mut group = c.benchmark_group("frame");
    group
        .sample_size(10)
        .sampling_mode(SamplingMode::Flat)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(4));
    for workload in workloads().expect("every workload can be built") {
        let Workload { name, frames, .. } = &workload;
        let mut clocked = Clocked::new(&workload).expect("every workload settles");
        let mut play = || clocked.play().expect("a world restores its own state");
        println!("{name}: after {frames} frames {}", play().hash);
        // The mean frame, without the time of restoring the state.
        let mut frame = || play().frames.iter().sum::<f64>() / *frames as f64;
        group.bench_function(name, |b| {
            b.iter_custom(|times| Duration::from_secs_f64(1e-3 * (0..times).map(|_| frame()).sum::<f64>()))
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
