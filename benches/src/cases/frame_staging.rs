//! Case `frame_staging`: a frame's uploads through the staging ring against wgpu's own ways, with one to four frames in flight.

use std::num::NonZeroU64;

use open_water_shaders::pipeline::Staging;

use crate::evidence::{Case, CaseError, Context, Gpu, Row, measure_together};

/// See the module.
pub(super) const STAGING: Case = Case {
    name: "frame_staging",
    about: "a frame's bytes to the device: the staging ring against Queue::write_buffer and StagingBelt, and what the ring holds",
    plots: &[],
    run,
};

/// What a frame writes, bytes: tables, then heights.
const WRITES: [usize; 3] = [4 << 10, 2 << 10, 8 * 384 * 384];

/// A way of uploading, with frames in flight.
struct Host<'a> {
    gpu: &'a Gpu,
    target: wgpu::Buffer,
    bytes: Vec<u8>,
    flight: usize,
    frame: usize,
}

impl Host<'_> {
    /// Encodes and submits a frame; waits once as many as may be are in flight.
    fn frame(&mut self, encode: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer, &[u8])) {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        encode(&mut encoder, &self.target, &self.bytes);
        self.gpu.queue.submit([encoder.finish()]);
        self.frame += 1;
        if self.frame.is_multiple_of(self.flight) {
            let _ = self.gpu.wait();
        }
    }
}

/// Places in the target, and the bytes for them.
fn parts(bytes: &[u8]) -> impl Iterator<Item = (u64, &[u8])> {
    WRITES.iter().scan(0, move |at, count| {
        let from = *at;
        *at += count;
        Some((from as u64, &bytes[from..*at]))
    })
}

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let total: usize = WRITES.iter().sum();
    let mut rows = Vec::new();
    for flight in 1..=4 {
        let host = || Host {
            gpu,
            target: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: total as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            bytes: vec![7; total],
            flight,
            frame: 0,
        };
        let (mut ours, mut theirs, mut belts) = (host(), host(), host());
        let mut staging = Staging::new(&gpu.device);
        let mut belt = wgpu::util::StagingBelt::new(gpu.device.clone(), 2 << 20);
        let mut held = 0;
        let mut ring = || {
            ours.frame(|encoder, target, bytes| {
                let Some(mut frame) = staging.frame(encoder) else { return };
                for (at, bytes) in parts(bytes) {
                    frame.write(target, at, bytes);
                }
            });
            held = staging.memory();
        };
        let mut queue = || {
            theirs.frame(|_, target, bytes| {
                for (at, bytes) in parts(bytes) {
                    gpu.queue.write_buffer(target, at, bytes);
                }
            });
        };
        let mut belt = || {
            belts.frame(|encoder, target, bytes| {
                for (at, bytes) in parts(bytes) {
                    if let Some(size) = NonZeroU64::new(bytes.len() as u64) {
                        belt.write_buffer(encoder, target, at, size).copy_from_slice(bytes);
                    }
                }
                belt.finish_and_recall_on_submit(encoder);
            });
        };
        let timings = measure_together(context.effort, [&mut ring, &mut queue, &mut belt]);
        let [own, _, belt] = timings.each_ref().map(|timing| timing.median_ns);
        rows.push(
            Row::new("frame_staging", format!("{flight} in flight"))
                .param("KiB_a_frame", total / 1024)
                .param("MB_a_second", (total as f64 / own * 1e3).round())
                .param("StagingBelt_ms", (belt * 1e-3).round() / 1e3)
                .error(
                    held as f64 / f64::from(1 << 20),
                    "MiB at the end",
                    "2 MiB for each frame in flight and the next",
                )
                .bound(2.0 * (flight as f64 + 1.0))
                .time("a frame written, encoded, submitted, and waited for when as many are in flight", &timings[0])
                .baseline("Queue::write_buffer", &timings[1]),
        );
    }
    Ok(rows)
}
