//! Writes the queued ticks, and the drawing of grids, into encoders.

use open_water_shaders::grid::{self as shader, DRAW_THREADS, TickParams, TickWater};

use super::flight::Flight;
use super::pack::{self, Kind};
use super::water::Bases;
use super::water_pass::WaterGroups;
use super::{GpuGridId, GpuGrids, MAX_GRIDS, pass};

impl GpuGrids {
    /// What the grids need of the buffers.
    fn needs(&self) -> (u64, Bases, [bool; 2]) {
        let felt = self.grids.iter().filter(|grid| grid.cells().is_some());
        let felt = felt.fold([false; 2], |[_, water], grid| [true, water || grid.water.is_some()]);
        (u64::from(self.state_vectors()), self.water_end(), felt)
    }

    pub(super) fn reserve(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        let (vectors, water, felt) = self.needs();
        self.buffers.reserve_state(device, encoder, vectors, water, felt);
    }

    /// Makes the memory and the pipelines that the grids need as they are, so that [`Self::encode`] need not: where it
    /// cannot be made, this is the call that fails (see [`open_water_shaders::pipeline::guarded`]), and
    /// [`Self::unprepare`] after the grid was removed leaves all as it was.
    pub fn prepare(&mut self, device: &wgpu::Device) {
        let (vectors, water, felt) = self.needs();
        self.buffers.prepare(device, vectors, water, felt);
        if self.grids.iter().any(|grid| grid.water.is_some() && !grid.removed) {
            self.passes.need_water(device);
        }
    }

    /// Lets go of what was prepared for nothing.
    pub fn unprepare(&mut self) {
        self.buffers.unprepare();
        while self.grids.pop_if(|grid| grid.removed && grid.ticks == 0).is_some() {}
        self.passes.water = self.passes.water.take().filter(|_| self.grids.iter().any(|grid| grid.water.is_some()));
    }

    /// Encodes the queued ticks, and takes what has come back of earlier ones. Submit the encoder, or drop it, before
    /// encoding again: the ticks of an encoder that was dropped are encoded anew, before those queued since.
    pub fn encode(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder) {
        self.activity.poll(device, &mut self.grids);
        self.encoded_ticks = self.queued_ticks;
        if let Some((flight, mut ticks)) = self.sent.take() {
            if flight.is_lost() {
                ticks.append(&mut self.ticks);
                self.ticks = ticks;
            } else {
                self.packer.reuse(ticks.into_iter());
            }
        }
        let Some(last) = self.ticks.back() else { return };
        self.activity.expect(&last.grids);
        let counts = (self.ticks.len() - 1) as u64 * u64::from(4 * shader::COUNT_WORDS);
        self.reserve(device, encoder);
        if self.ticks.iter().any(|tick| tick.water.is_some()) {
            self.passes.need_water(device);
        }
        let groups = self.buffers.upload(device, queue, &self.passes, &mut self.ticks);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("grids"), ..Default::default() });
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
        drop(pass);
        self.activity.encode(encoder, &groups.counts, counts);
        self.sent = Some((Flight::board(encoder), std::mem::take(&mut self.ticks)));
    }

    /// Encodes the drawing of grids as of the last encoded tick: (height, foam) of cell (i, j) goes to element
    /// `base + j * nx + i` of `pool`, a storage buffer of `vec2<f32>`. `alpha` as in [`crate::WaveGrid::draw`]. Asleep
    /// grids are drawn as zeros.
    pub fn encode_draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        pool: &wgpu::Buffer,
        draws: &[(GpuGridId, u32)],
        alpha: f32,
    ) {
        if draws.is_empty() {
            return;
        }
        let alpha = if alpha.is_nan() { 1.0 } else { alpha.clamp(0.0, 1.0) };
        self.reserve(device, encoder);
        let draws: Vec<_> = draws.iter().take(MAX_GRIDS).map(|(id, out)| self.grids[id.0].drawn(alpha, *out)).collect();
        let [x, y] = [0, 1].map(|k| draws.iter().map(|d| d.cells[k]).max().unwrap_or(0));
        let draw_group = self.buffers.upload_draws(device, queue, &self.passes, pool, &draws);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("grid draw"), ..Default::default() });
        let felt = draws.iter().any(|draw| draw.medium != shader::NO_MEDIUM);
        let holes = draws.iter().any(|draw| draw.hole_count > 0);
        pass.set_pipeline(&self.passes.draw[usize::from(felt)][usize::from(holes)]);
        pass.set_bind_group(0, draw_group, &[]);
        pass.dispatch_workgroups(x.div_ceil(DRAW_THREADS), y, draws.len() as u32);
    }
}
