//! Writes the queued ticks, and the drawing of grids, into encoders.
//!
//! Each in three parts, so that a host can put the middle ones of all into one compute pass: what is uploaded, what is
//! dispatched, what is copied back.

use open_water_shaders::grid::{self as shader, DRAW_THREADS, TickParams, TickWater};
use open_water_shaders::pipeline::Frame;

use super::pack::{self, Kind};
use super::water::Bases;
use super::water_pass::WaterGroups;
use super::{GpuGridId, GpuGrids, MAX_GRIDS, pass};

/// What [`GpuGrids::record_draw`] dispatches.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawing {
    felt: bool,
    holes: bool,
    workgroups: [u32; 3],
}

impl GpuGrids {
    /// What the grids need of the buffers.
    fn needs(&self) -> (u64, Bases, [bool; 2]) {
        let felt = self.grids.iter().filter(|grid| grid.cells().is_some());
        let felt = felt.fold([false; 2], |[_, water], grid| [true, water || grid.water.is_some()]);
        (u64::from(self.state_vectors()), self.water_end(), felt)
    }

    pub(super) fn reserve(&mut self, frame: &mut Frame<'_>) {
        let (vectors, water, felt) = self.needs();
        self.buffers.reserve_state(frame, vectors, water, felt);
    }

    /// Makes the memory and the pipelines that the grids need as they are, so that [`Self::encode`] need not: where it
    /// cannot be made, this is the call that fails (see [`open_water_shaders::pipeline::guarded`]), and
    /// [`Self::unprepare`] after the grid was removed leaves all as it was.
    pub fn prepare(&mut self, device: &wgpu::Device) {
        let (vectors, water, felt) = self.needs();
        self.buffers.prepare(device, vectors, water, felt);
        let mut left = self.grids.iter().filter(|grid| !grid.removed).peekable();
        if left.peek().is_some() {
            self.passes.need(device, left.any(|grid| grid.water.is_some()));
        }
    }

    /// A job for another thread that compiles beforehand what grids of any kind need, so that the first one need not. A grid
    /// that comes meanwhile waits for it; what is refused is told when a grid needs it. `None` where it was asked for already.
    pub fn compiler(&mut self, device: &wgpu::Device) -> Option<impl FnOnce() + use<>> {
        self.passes.compiler(device)
    }

    /// Whether all that [`Self::compiler`] compiles is there, or was refused.
    pub fn is_compiled(&self) -> bool {
        self.passes.is_over()
    }

    /// Lets go of what was prepared for nothing.
    pub fn unprepare(&mut self) {
        self.buffers.unprepare();
        while self.grids.pop_if(|grid| grid.removed && grid.ticks == 0).is_some() {}
    }

    /// Encodes the queued ticks, and takes what has come back of earlier ones. The ticks of encoders that were dropped are
    /// encoded anew, before those queued since; who drops one must drop those encoded after it.
    pub fn encode(&mut self, frame: &mut Frame<'_>) {
        if self.upload(frame) {
            let of = wgpu::ComputePassDescriptor { label: Some("grids"), ..Default::default() };
            let _ = self.record(&mut frame.encoder.begin_compute_pass(&of));
            self.finish(frame);
        }
    }

    /// The first part of [`Self::encode`]: uploads. Returns whether the others are to follow: [`Self::record`], then
    /// [`Self::finish`]; without memory for the upload the ticks wait.
    pub fn upload(&mut self, frame: &mut Frame<'_>) -> bool {
        self.activity.poll(frame.device(), &mut self.grids);
        while let Some((_, ticks)) = self.sent.pop_front_if(|(number, _)| frame.has_landed(*number)) {
            self.packer.reuse(ticks.into_iter());
        }
        for at in (0..self.sent.len()).rev() {
            if frame.is_lost(self.sent[at].0)
                && let Some((_, mut ticks)) = self.sent.remove(at)
            {
                ticks.append(&mut self.ticks);
                self.ticks = ticks;
            }
        }
        if self.ticks.is_empty() {
            self.encoded_ticks = self.queued_ticks;
            return false;
        }
        self.reserve(frame);
        let any_water = self.ticks.iter().any(|tick| tick.water.is_some());
        self.passes.need(frame.device(), any_water);
        if !self.buffers.upload(frame, &mut self.ticks) {
            return false;
        }
        self.encoded_ticks = self.queued_ticks;
        self.buffers.bind(frame.device(), &self.passes, any_water);
        true
    }

    /// The second part of [`Self::encode`]: dispatches. Returns their number.
    pub fn record(&self, pass: &mut wgpu::ComputePass<'_>) -> u32 {
        let Some(groups) = self.buffers.groups() else { return 0 };
        let mut dispatch = 0;
        for (index, tick) in (0..).zip(&self.ticks) {
            let params = index * size_of::<TickParams>() as u32;
            let water = index * size_of::<TickWater>() as u32;
            for work in tick.dispatches() {
                let own = |of: fn(&WaterGroups) -> &wgpu::BindGroup| groups.water.as_ref().map(of);
                let (lists, offset): (_, &[u32]) = match work.kind {
                    Kind::Schedule => (Some(&groups.schedule), &[]),
                    Kind::Medium | Kind::Prepare { .. } | Kind::Step { .. } => (Some(&groups.lists), &[]),
                    Kind::WaterMedium => (own(|groups| &groups.medium), &[water]),
                    Kind::WaterPrepare => (own(|groups| &groups.prepare), &[water]),
                    Kind::WaterStep { .. } => (own(|groups| &groups.step), &[water]),
                };
                // All are there once compiled.
                let (Some(pipeline), Some(lists)) = (self.passes.of(work.kind), lists) else { continue };
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &groups.state, &[dispatch * pass::DISPATCH_STRIDE, params]);
                pass.set_bind_group(1, lists, offset);
                match work.groups {
                    pack::Groups::Counted(count) => pass.dispatch_workgroups(count, 1, 1),
                    pack::Groups::Listed(list) => {
                        let word = u64::from(index * shader::COUNT_WORDS + 4 * list);
                        pass.dispatch_workgroups_indirect(&groups.counts, 4 * word);
                    }
                }
                dispatch += 1;
            }
        }
        dispatch
    }

    /// The last part of [`Self::encode`]: the copy of what comes back.
    pub fn finish(&mut self, frame: &mut Frame<'_>) {
        let Some((last, groups)) = self.ticks.back().zip(self.buffers.groups()) else { return };
        self.activity.expect(&last.grids);
        let counts = (self.ticks.len() - 1) as u64 * u64::from(4 * shader::COUNT_WORDS);
        self.activity.encode(frame.encoder, &groups.counts, counts);
        self.sent.push_back((frame.watch(), std::mem::take(&mut self.ticks)));
    }

    /// Encodes the drawing of grids as of the last encoded tick: (height, foam) of cell (i, j) goes to element
    /// `base + j * nx + i` of `pool`, a storage buffer of `vec2<f32>`. `alpha` as in [`crate::WaveGrid::draw`]. Asleep
    /// grids are drawn as zeros.
    pub fn encode_draw(&mut self, frame: &mut Frame<'_>, pool: &wgpu::Buffer, draws: &[(GpuGridId, u32)], alpha: f32) {
        if self.upload_draw(frame, pool, draws, alpha) {
            let of = wgpu::ComputePassDescriptor { label: Some("grid draw"), ..Default::default() };
            let _ = self.record_draw(&mut frame.encoder.begin_compute_pass(&of));
        }
    }

    /// The first part of [`Self::encode_draw`]: uploads. Returns whether there is anything for [`Self::record_draw`].
    pub fn upload_draw(
        &mut self,
        frame: &mut Frame<'_>,
        pool: &wgpu::Buffer,
        draws: &[(GpuGridId, u32)],
        alpha: f32,
    ) -> bool {
        self.drawing = None;
        if draws.is_empty() {
            return false;
        }
        let alpha = if alpha.is_nan() { 1.0 } else { alpha.clamp(0.0, 1.0) };
        self.reserve(frame);
        let Self { grids, drawn, .. } = self;
        drawn.clear();
        drawn.extend(draws.iter().take(MAX_GRIDS).map(|(id, out)| grids[id.0].drawn(alpha, *out)));
        let [x, y] = [0, 1].map(|k| drawn.iter().map(|d| d.cells[k]).max().unwrap_or(0));
        self.drawing = Some(Drawing {
            felt: drawn.iter().any(|draw| draw.medium != shader::NO_MEDIUM),
            holes: drawn.iter().any(|draw| draw.hole_count > 0),
            workgroups: [x.div_ceil(DRAW_THREADS), y, drawn.len() as u32],
        });
        self.passes.need(frame.device(), false);
        self.buffers.upload_draws(frame, &self.passes, pool, drawn);
        true
    }

    /// The second part of [`Self::encode_draw`]: one dispatch, after those of [`Self::record`]. Returns their number.
    pub fn record_draw(&self, pass: &mut wgpu::ComputePass<'_>) -> u32 {
        let Some((Drawing { felt, holes, workgroups: [x, y, z] }, group)) = self.drawing.zip(self.buffers.draw_group())
        else {
            return 0;
        };
        let Some(waves) = self.passes.waves() else { return 0 };
        pass.set_pipeline(&waves.draw[usize::from(felt)][usize::from(holes)]);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(x, y, z);
        1
    }
}
