//! Grids that are stepped on the GPU: commands from the ticks go there, drawn heights come back some frames later.
//!
//! Nothing waits: a sample is carried on from the last copy that has arrived, and says how old that is.

mod plan;

use std::sync::Arc;

use glam::{DVec2, Vec2};
use open_water_shaders::pipeline::{Frame, Readback, Reading};
use wave_grid::gpu::{GpuGridId, GpuGrids, Stored};
use wave_grid::{GridSample, Hole, Medium, Source, Window};

use super::hulls::Hull;
use super::mirror::Mirror;
use crate::OpenWaterError;
use crate::grids::{Grids, Sim};
use crate::plan::FramePlan;
use crate::sea::beside;

/// Copies under way at most: of four frames in flight, and of the one that is being encoded.
const SLOTS: usize = 5;

/// Where and when a copy was made.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stamp {
    tick: u64,
    corner: [i64; 2],
}

/// A grid's CPU side: what the next tick tells it, and what came back of it.
pub(crate) struct RemoteGrid {
    pub(crate) id: GpuGridId,
    window: Window,
    awake: bool,
    target: Option<DVec2>,
    nested: bool,
    /// What it shows with a gain of 1, as of the last tick.
    hole: Hole,
    holes: Vec<Hole>,
    sources: Vec<Source>,
    /// Those that are in it.
    hulls: Vec<Hull>,
    ring: Readback<Stamp>,
    /// The tick that was copied last.
    copied: u64,
    mirror: Mirror,
}

impl RemoteGrid {
    pub(crate) fn sample(&self, points: &[Vec2], out: &mut [GridSample]) {
        self.mirror.sample(points, &self.hole, &self.holes, out);
    }

    /// Age (s) and standard deviation (m) of a sample at a local point; `None` where nothing is shown.
    pub(crate) fn doubt(&self, point: Vec2) -> Option<[f32; 2]> {
        if !self.awake {
            return None;
        }
        match self.mirror.tick() {
            Some(_) => self.mirror.doubt(point, &self.hole),
            None => {
                let place = self.mirror.origin + point.as_dvec2();
                let seen = (0..2).all(|k| self.hole.fade(k, place[k]) > 0.0);
                seen.then_some([0.0, f32::INFINITY])
            }
        }
    }

    pub(crate) fn window(&self) -> Window {
        self.window
    }

    pub(crate) fn set_origin(&mut self, origin: DVec2) {
        self.mirror.origin = origin;
    }

    pub(crate) fn center_on(&mut self, target: DVec2) {
        self.target = Some(target);
    }

    pub(crate) fn add(&mut self, source: Source) {
        self.sources.push(source);
    }

    /// A hull is in it in this tick.
    pub(crate) fn meet(&mut self, hull: Hull) {
        self.hulls.push(hull);
    }

    pub(crate) fn hole(&self, gain: f32) -> Hole {
        self.hole.with_gain(gain)
    }

    pub(crate) fn set_holes(&mut self, holes: &[Hole]) {
        self.holes.clear();
        self.holes.extend_from_slice(holes);
    }

    pub(crate) fn set_nested(&mut self, nested: bool) {
        self.nested = nested;
    }

    pub(crate) fn is_awake(&self) -> bool {
        self.awake
    }

    /// Its device is gone, and its waves with it.
    pub(crate) fn end(&mut self) {
        self.awake = false;
        self.sources.clear();
        self.hulls.clear();
        self.mirror.still();
    }
}

/// All of them on the device.
pub(crate) struct RemoteGrids {
    device: wgpu::Device,
    grids: GpuGrids,
    /// What is drawn, and where in the pool.
    draws: Vec<(GpuGridId, u32)>,
    /// The last tick queued.
    tick: u64,
    /// Heights on their way from a copy.
    heights: [Vec<f32>; 2],
}

impl RemoteGrids {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        Self {
            device: device.clone(),
            grids: GpuGrids::new(device),
            draws: Vec::new(),
            tick: 0,
            heights: Default::default(),
        }
    }

    pub(crate) fn add(&mut self, desc: wave_grid::GridDesc) -> Result<RemoteGrid, OpenWaterError> {
        let id = self.grids.insert(desc)?;
        let window = self.grids.window(id);
        let bytes = 2 * self.grids.height_bytes(id);
        Ok(RemoteGrid {
            id,
            window,
            awake: false,
            target: None,
            nested: false,
            hole: self.grids.hole(id, 1.0),
            holes: Vec::new(),
            sources: Vec::new(),
            hulls: Vec::new(),
            ring: Readback::new(&self.device, "grid readback", bytes, SLOTS),
            copied: 0,
            mirror: Mirror::new(desc.cells, desc.cell_size, desc.tick),
        })
    }

    /// Has compiled beside what grids need, once. Returns whether it is there, or was refused.
    pub(crate) fn compile_beside(&mut self) -> bool {
        if let Some(job) = self.grids.compiler(&self.device) {
            beside(job);
        }
        self.grids.is_compiled()
    }

    /// Makes what the grids need of the device.
    pub(crate) fn prepare(&mut self) {
        self.grids.prepare(&self.device);
    }

    /// Puts a grid where another one was, on another device.
    pub(crate) fn place(&mut self, grid: &mut RemoteGrid, old: &RemoteGrid) {
        let window = old.window;
        let middle =
            |k: usize| (window.corner[k] as f64 + 0.5 * f64::from(window.cells[k])) * f64::from(window.cell_size[k]);
        self.grids.set_nested(grid.id, old.nested);
        self.stand(grid, DVec2::new(middle(0), middle(1)));
        grid.nested = old.nested;
        grid.holes.clone_from(&old.holes);
    }

    /// A calm grid stands around a world place at once.
    pub(crate) fn stand(&mut self, grid: &mut RemoteGrid, place: DVec2) {
        self.grids.center_on(grid.id, place);
        grid.window = self.grids.window(grid.id);
        grid.hole = self.grids.hole(grid.id, 1.0);
    }

    /// Takes back what was added last, for which there was no room.
    pub(crate) fn take_back(&mut self, id: GpuGridId) {
        self.grids.remove(id);
        self.grids.unprepare();
    }

    pub(crate) fn remove(&mut self, id: GpuGridId) {
        self.grids.remove(id);
    }

    /// World place of what is local from now on.
    pub(crate) fn set_origin(&mut self, origin: DVec2) {
        self.grids.set_origin(origin);
    }

    /// What the waves of all grids travel through.
    pub(crate) fn set_medium(&mut self, medium: Option<Arc<dyn Medium>>) {
        self.grids.set_medium(medium);
    }

    /// Passes on what tick number `tick` brought, queues it for all grids, and takes what has come back.
    pub(crate) fn tick(&mut self, grids: &mut Grids, tick: u64) {
        let mut any = false;
        self.tick = tick;
        for grid in grids.iter_mut() {
            let Sim::Gpu(remote) = &mut grid.sim else { continue };
            any = true;
            for source in remote.sources.drain(..) {
                self.grids.add(remote.id, source);
            }
            if let Some(target) = remote.target.take() {
                self.grids.center_on(remote.id, target);
            }
            self.grids.set_nested(remote.id, remote.nested);
            remote.window = self.grids.window(remote.id);
            remote.hole = self.grids.hole(remote.id, 1.0);
            remote.awake = !self.grids.is_asleep(remote.id);
            self.take(remote);
            if remote.awake {
                remote.mirror.follow(tick, &remote.hulls);
            } else {
                remote.mirror.still();
            }
            remote.hulls.clear();
        }
        if any {
            self.grids.tick();
        }
    }

    /// Takes what has come back of a grid.
    fn take(&mut self, remote: &mut RemoteGrid) {
        let Some(Reading { stamp, bytes }) = remote.ring.poll(&self.device) else { return };
        let Self { grids, heights, .. } = self;
        remote.mirror.take(stamp.tick, remote.window.corner, |out| {
            for (heights, bytes) in heights.iter_mut().zip(bytes.chunks_exact((bytes.len() / 2).max(1))) {
                heights.clear();
                heights.extend(bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_ne_bytes(*bytes)));
            }
            let [now, before] = &*heights;
            grids.arrange(remote.id, stamp.corner, [now, before], out)
        });
    }

    /// Uploads what was queued. Returns whether there is something to step.
    pub(crate) fn upload_steps(&mut self, frame: &mut Frame<'_>) -> bool {
        self.grids.upload(frame)
    }

    /// Steps it. Returns the number of dispatches.
    pub(crate) fn record_steps(&self, pass: &mut wgpu::ComputePass<'_>) -> u32 {
        self.grids.record(pass)
    }

    /// Notes that it was stepped.
    pub(crate) fn finish_steps(&mut self, frame: &mut Frame<'_>) {
        self.grids.finish(frame);
    }

    /// Uploads what to draw of the grids that the plan lists. Returns whether there is something to draw.
    pub(crate) fn upload_draw(
        &mut self,
        frame: &mut Frame<'_>,
        pool: &wgpu::Buffer,
        plan: &FramePlan,
        grids: &Grids,
    ) -> bool {
        self.draws.clear();
        for grid in grids.iter() {
            if let Sim::Gpu(remote) = &grid.sim
                && plan.listed.contains(&grid.id)
            {
                self.draws.push((remote.id, grid.base));
                self.grids.set_holes(remote.id, &remote.holes);
            }
        }
        self.grids.upload_draw(frame, pool, &self.draws, plan.alpha)
    }

    /// Draws into the pool. Returns the number of dispatches.
    pub(crate) fn record_draw(&self, pass: &mut wgpu::ComputePass<'_>) -> u32 {
        self.grids.record_draw(pass)
    }

    /// Copies the heights of the last tick for the way back, each tick once.
    pub(crate) fn finish_copies(&self, frame: &mut Frame<'_>, grids: &mut Grids) {
        for grid in grids.iter_mut() {
            if let Sim::Gpu(remote) = &mut grid.sim
                && remote.awake
                && remote.copied != self.tick
                && let Some(Stored { buffer, offsets: [now, before], bytes }) = self.grids.stored(remote.id)
            {
                let stamp = Stamp { tick: self.tick, corner: remote.window.corner };
                let parts = [(buffer, now, bytes), (buffer, before, bytes)];
                // Left out when the GPU is too far behind: the mirror just gets older.
                if remote.ring.encode_parts(frame.encoder, &parts, stamp) {
                    remote.copied = self.tick;
                }
            }
        }
    }
}
