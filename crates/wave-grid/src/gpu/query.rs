//! Samples of the grids at points, asked now and answered some frames later.

use glam::{DVec2, Vec2};
use open_water_shaders::grid::{self as shader, GridQueries, GridQuery, QUERY_THREADS};
use open_water_shaders::pipeline::{Frame, Readback, Slot, bind_group, compute_pipeline, group_layout};

use super::{GpuGrids, MAX_GRIDS, grid::Grid};
use crate::GridSample;

/// Queries under way at most.
const SLOTS: usize = 4;
/// Most points of a query.
pub const MAX_QUERY_POINTS: usize = 1 << 20;
/// A coordinate that no window reaches.
const NOWHERE: f32 = 1e30;

/// The newest answer of [`GpuGrids::poll_query`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer<'a> {
    /// The sum of all grids at each point of the query, in its order.
    pub samples: &'a [GridSample],
    /// How many ticks were queued since the one whose end was sampled.
    pub age: u64,
}

/// Pipelines, buffers and answers.
#[derive(Debug)]
pub(super) struct Queries {
    layout: wgpu::BindGroupLayout,
    /// Without and with grids that have walls; none before the first query.
    pipelines: Option<[wgpu::ComputePipeline; 2]>,
    lists: Option<Lists>,
    /// The newest answer, the tick it is of, and the number of its copy.
    samples: Vec<GridSample>,
    of: Option<u64>,
}

/// What holds a number of points.
#[derive(Debug)]
struct Lists {
    uniform: wgpu::Buffer,
    points: wgpu::Buffer,
    samples: wgpu::Buffer,
    ring: Readback<u64>,
}

impl Queries {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let uniform = Slot::Uniform { size: size_of::<GridQueries>() };
        let slots = [uniform, Slot::Read, Slot::Read, Slot::Read, Slot::ReadWrite];
        let layout = group_layout(device, "grid query", compute, &slots);
        Self { layout, pipelines: None, lists: None, samples: Vec::new(), of: None }
    }

    fn pipelines(&mut self, device: &wgpu::Device) -> &[wgpu::ComputePipeline; 2] {
        let layout = &self.layout;
        let pipeline =
            |medium| compute_pipeline(device, &shader::QUERY, shader::QUERY.name, &[layout], &[("MEDIUM", medium)]);
        self.pipelines.get_or_insert_with(|| [0.0, 1.0].map(pipeline))
    }
}

impl Lists {
    fn new(device: &wgpu::Device, points: usize) -> Self {
        let buffer = |label, bytes: usize, usage| {
            let (size, mapped_at_creation) = (bytes as u64, false);
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation })
        };
        let (storage, copied) = (wgpu::BufferUsages::STORAGE, wgpu::BufferUsages::COPY_DST);
        let bytes = points * size_of::<[f32; 4]>();
        Self {
            uniform: buffer("grid queries", size_of::<GridQueries>(), wgpu::BufferUsages::UNIFORM | copied),
            points: buffer("grid query points", points * size_of::<Vec2>(), storage | copied),
            samples: buffer("grid query samples", bytes, storage | wgpu::BufferUsages::COPY_SRC),
            ring: Readback::new(device, "grid query", bytes as u64, SLOTS),
        }
    }

    fn capacity(&self) -> usize {
        self.points.size() as usize / size_of::<Vec2>()
    }
}

impl GpuGrids {
    /// Encodes a query of all grids at local points (x, z), metres, as they are after the ticks encoded so far: the answer
    /// comes back through [`Self::poll_query`] once the encoder has been submitted and done. Points that are not finite
    /// are answered with zeros. A larger query than any before forgets those under way.
    ///
    /// Returns whether it was encoded: not when four are under way already, when there is no point, or more than
    /// [`MAX_QUERY_POINTS`].
    pub fn encode_query(&mut self, frame: &mut Frame<'_>, points: &[Vec2]) -> bool {
        if points.is_empty() || points.len() > MAX_QUERY_POINTS {
            return false;
        }
        self.reserve(frame);
        let mut lists = match self.queries.lists.take() {
            Some(lists) if lists.capacity() >= points.len() => lists,
            _ => Lists::new(frame.device(), points.len().next_power_of_two().max(64)),
        };
        let mut asked = GridQueries { points: points.len() as u32, ..Default::default() };
        let present = self.grids.iter().filter(|grid| !grid.removed).take(MAX_GRIDS);
        for (grid, entry) in present.zip(&mut asked.list) {
            *entry = grid.queried(self.origin);
            asked.grids += 1;
        }
        let felt = asked.list.iter().any(|grid| grid.medium != shader::NO_MEDIUM);
        let finite: Vec<Vec2> =
            points.iter().map(|point| if point.is_finite() { *point } else { Vec2::splat(NOWHERE) }).collect();
        frame.write(&lists.uniform, 0, bytemuck::bytes_of(&asked));
        frame.write(&lists.points, 0, bytemuck::cast_slice(&finite));
        let [heights, ground] = self.buffers.heights_and_ground();
        let resources = [&lists.uniform, heights, ground, &lists.points, &lists.samples];
        let resources = resources.map(wgpu::Buffer::as_entire_binding);
        let group = bind_group(frame.device(), "grid query", &self.queries.layout, &resources);
        let of = wgpu::ComputePassDescriptor { label: Some("grid query"), ..Default::default() };
        let device = frame.device().clone();
        let mut pass = frame.encoder.begin_compute_pass(&of);
        pass.set_pipeline(&self.queries.pipelines(&device)[usize::from(felt)]);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(asked.points.div_ceil(QUERY_THREADS), 1, 1);
        drop(pass);
        let bytes = (points.len() * size_of::<[f32; 4]>()) as u64;
        let encoded = lists.ring.encode(frame.encoder, &lists.samples, 0, bytes, self.encoded_ticks);
        self.queries.lists = Some(lists);
        encoded
    }

    /// The newest answer there is, without waiting; `None` before the first.
    pub fn poll_query(&mut self, device: &wgpu::Device) -> Option<Answer<'_>> {
        let Queries { lists, samples, of, .. } = &mut self.queries;
        if let Some(reading) = lists.as_mut().and_then(|lists| lists.ring.poll(device)) {
            let values: &[[u8; 16]] = reading.bytes.as_chunks().0;
            samples.clear();
            samples.extend(values.iter().map(|bytes| {
                let [height, x, z, vertical_velocity] = bytemuck::pod_read_unaligned::<[f32; 4]>(bytes);
                GridSample { height, slope: Vec2::new(x, z), vertical_velocity }
            }));
            *of = Some(reading.stamp);
        }
        let of = (*of)?;
        Some(Answer { samples: &self.queries.samples, age: self.queued_ticks - of })
    }
}

impl Grid {
    fn queried(&self, origin: DVec2) -> GridQuery {
        let drawn = self.drawn(1.0, 0);
        let window = &self.place.window;
        let h = window.cell_size.map(f64::from);
        let offset = window.cells_from_corner(Vec2::ZERO, origin);
        let old = 4 * (self.base + (1 - self.parity) * self.stride());
        GridQuery {
            corner: drawn.corner,
            cells: drawn.cells,
            torus: drawn.torus,
            middle: drawn.middle,
            outer: drawn.outer,
            scale: h.map(|h| (1.0 / h) as f32),
            offset: [offset.x as f32, offset.y as f32],
            width: drawn.width,
            rate: (1.0 / self.stepping.dt) as f32,
            now: drawn.now,
            old,
            medium: drawn.medium,
            pad: 0,
        }
    }
}
