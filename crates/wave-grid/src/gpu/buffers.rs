//! The buffers of the grids: state that stays, lists that are uploaded. They grow, and keep what they hold.

use std::collections::VecDeque;

use bytemuck::{NoUninit, Zeroable};
use open_water_shaders::grid::{
    ACTIVE_WORD, ARRAYS, COUNT_WORDS, GridCell, GridDispatch, GridDraw, GridSource, GridTile, GridWaterCell,
    LIST_COUNT, MEDIUM_ARRAYS, TILE, TickParams, TickWater,
};
use open_water_shaders::pipeline::{Frame, bind_group};

use super::MAX_GRIDS;
use super::pack::{self, Tick, Work};
use super::pass::{DISPATCH_STRIDE, Passes};
use super::water::Bases;
use super::water_pass::WaterGroups;

/// A buffer that is written anew and grows in powers of two.
#[derive(Debug)]
struct List {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: wgpu::Buffer,
}

impl List {
    fn new(device: &wgpu::Device, label: &'static str, usage: wgpu::BufferUsages, bytes: u64) -> Self {
        Self { label, usage, buffer: create(device, label, usage | wgpu::BufferUsages::COPY_DST, bytes) }
    }

    /// Returns whether the buffer is another one now.
    fn write<T: NoUninit>(&mut self, frame: &mut Frame<'_>, data: &[T]) -> bool {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let grown = bytes.len() as u64 > self.buffer.size();
        if grown {
            *self = Self::new(frame.device(), self.label, self.usage, (bytes.len() as u64).next_power_of_two());
        }
        frame.write(&self.buffer, 0, bytes);
        grown
    }
}

/// The first `size` bytes, to be moved by a dynamic offset.
fn first(list: &List, size: usize) -> wgpu::BindingResource<'_> {
    let size = std::num::NonZeroU64::new(size as u64);
    wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: &list.buffer, offset: 0, size })
}

fn create(device: &wgpu::Device, label: &str, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}

/// A dispatch's uniform with padding up to the next.
type Slot = [GridDispatch; DISPATCH_STRIDE as usize / size_of::<GridDispatch>()];

/// All buffers, and the bind groups made of them.
#[derive(Debug)]
pub(super) struct Buffers {
    dispatches: List,
    params: List,
    tiles: List,
    sources: List,
    cells: List,
    draws: List,
    heights: wgpu::Buffer,
    memory: wgpu::Buffer,
    /// Empty while every medium is plain.
    ground: wgpu::Buffer,
    /// Of dispersive grids: fields and what their layers remember, and the faces where the medium is not plain.
    fields: wgpu::Buffer,
    faces: wgpu::Buffer,
    water: List,
    water_cells: List,
    /// What the last step of every tile found.
    marks: wgpu::Buffer,
    /// What a schedule writes.
    list: wgpu::Buffer,
    /// Numbers of workgroups and tiles, of each queued tick.
    counts: List,
    groups: Option<Groups>,
    draw_group: Option<(wgpu::Buffer, wgpu::BindGroup)>,
    /// The dispatches' uniforms as uploaded.
    uniforms: Vec<Slot>,
    upload: Upload,
    /// Larger ones of those that are there already.
    ready: [Option<wgpu::Buffer>; 6],
    /// Heights, memory, medium, marks, fields and faces before they grew, until the encoder that copies them is done.
    outgrown: Vec<(u64, [wgpu::Buffer; 6])>,
}

/// What is uploaded of all queued ticks.
#[derive(Debug, Default)]
struct Upload {
    params: Vec<TickParams>,
    tiles: Vec<GridTile>,
    sources: Vec<GridSource>,
    cells: Vec<GridCell>,
    water: Vec<TickWater>,
    water_cells: Vec<GridWaterCell>,
    counts: Vec<u32>,
}

/// Bind groups of the ticks' passes.
#[derive(Debug)]
pub(super) struct Groups {
    pub(super) state: wgpu::BindGroup,
    pub(super) schedule: wgpu::BindGroup,
    pub(super) lists: wgpu::BindGroup,
    pub(super) counts: wgpu::Buffer,
    /// Where there are dispersive grids.
    pub(super) water: Option<WaterGroups>,
}

const STATE_USAGE: wgpu::BufferUsages =
    wgpu::BufferUsages::STORAGE.union(wgpu::BufferUsages::COPY_SRC).union(wgpu::BufferUsages::COPY_DST);

/// Names and sizes of heights, memory, medium, marks, fields and faces.
fn state_bytes(vectors: u64, water: Bases, felt: [bool; 2]) -> [(&'static str, u64); 6] {
    let bytes = 16 * vectors;
    let of_ground = bytes * u64::from(MEDIUM_ARRAYS) / u64::from(ARRAYS);
    [
        ("grid heights", bytes),
        ("grid memory", bytes),
        ("grid ground", if felt[0] { of_ground } else { 0 }),
        // Two words a tile.
        ("grid marks", 8 * vectors / u64::from(TILE * TILE)),
        ("grid fields", 16 * u64::from(water.fields)),
        ("grid faces", if felt[1] { 16 * u64::from(water.faces) } else { 0 }),
    ]
}

impl Buffers {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let list = |label, usage, bytes| List::new(device, label, usage, bytes);
        let (uniform, storage) = (wgpu::BufferUsages::UNIFORM, wgpu::BufferUsages::STORAGE);
        Self {
            dispatches: list("grid dispatches", uniform, 4096),
            params: list("grid params", uniform, size_of::<TickParams>() as u64),
            tiles: list("grid tiles", storage, 4096),
            sources: list("grid sources", storage, 4096),
            cells: list("grid cells", storage, 4096),
            draws: list("grid draws", uniform, (MAX_GRIDS * size_of::<GridDraw>()) as u64),
            heights: create(device, "grid heights", STATE_USAGE, 16),
            memory: create(device, "grid memory", STATE_USAGE, 16),
            ground: create(device, "grid ground", STATE_USAGE, 16),
            fields: create(device, "grid fields", STATE_USAGE, 16),
            faces: create(device, "grid faces", STATE_USAGE, 16),
            water: list("grid water", uniform, 16),
            water_cells: list("grid water cells", storage, 64),
            marks: create(device, "grid marks", STATE_USAGE, 16),
            list: create(device, "grid list", storage, 16),
            counts: list("grid counts", storage | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_SRC, 4096),
            groups: None,
            draw_group: None,
            uniforms: Vec::new(),
            upload: Upload::default(),
            ready: Default::default(),
            outgrown: Vec::new(),
        }
    }

    /// Makes room for `vectors` of state and for what dispersive grids have, and for their medium where it is `felt`, by any
    /// grid and by dispersive ones. What is there stays; what is new is zero.
    pub(super) fn reserve_state(&mut self, frame: &mut Frame<'_>, vectors: u64, water: Bases, felt: [bool; 2]) {
        self.settle(frame);
        let before = [&self.heights, &self.memory, &self.ground, &self.marks, &self.fields, &self.faces];
        let before = before.map(wgpu::Buffer::clone);
        let mut grown = false;
        let wanted = state_bytes(vectors, water, felt);
        let own =
            [&mut self.heights, &mut self.memory, &mut self.ground, &mut self.marks, &mut self.fields, &mut self.faces];
        for ((buffer, (label, bytes)), ready) in own.into_iter().zip(wanted).zip(&mut self.ready) {
            if bytes > buffer.size() {
                let ready = ready.take().filter(|ready| ready.size() >= bytes);
                let larger = ready.unwrap_or_else(|| create(frame.device(), label, STATE_USAGE, bytes));
                frame.encoder.copy_buffer_to_buffer(buffer, 0, &larger, 0, buffer.size());
                *buffer = larger;
                grown = true;
            }
        }
        if grown {
            self.groups = None;
            self.draw_group = None;
            self.outgrown.push((frame.watch(), before));
        }
    }

    /// Makes the buffers that [`Self::reserve_state`] will need, so that it need not.
    pub(super) fn prepare(&mut self, device: &wgpu::Device, vectors: u64, water: Bases, felt: [bool; 2]) {
        let own = [&self.heights, &self.memory, &self.ground, &self.marks, &self.fields, &self.faces];
        for ((buffer, (label, bytes)), ready) in
            own.into_iter().zip(state_bytes(vectors, water, felt)).zip(&mut self.ready)
        {
            let has = ready.as_ref().map_or(0, wgpu::Buffer::size).max(buffer.size());
            if bytes > has {
                *ready = Some(create(device, label, STATE_USAGE, bytes));
            }
        }
    }

    /// Lets go of what was prepared and has not been taken.
    pub(super) fn unprepare(&mut self) {
        self.ready = Default::default();
    }

    /// Takes back the buffers that an encoder should have copied that was dropped.
    fn settle(&mut self, frame: &Frame<'_>) {
        if let Some(lost) = self.outgrown.iter().position(|(number, _)| frame.is_lost(*number)) {
            for (_, before) in self.outgrown.drain(lost..).take(1) {
                [self.heights, self.memory, self.ground, self.marks, self.fields, self.faces] = before;
            }
            self.groups = None;
            self.draw_group = None;
        }
        self.outgrown.retain(|(number, _)| !frame.has_landed(*number));
    }

    /// Uploads the queued ticks. False without memory for it: then nothing was.
    pub(super) fn upload(&mut self, frame: &mut Frame<'_>, ticks: &mut VecDeque<Tick>) -> bool {
        let Self { uniforms, upload: Upload { params, tiles, sources, cells, water, water_cells, counts }, .. } = self;
        counts.clear();
        uniforms.clear();
        params.clear();
        tiles.clear();
        sources.clear();
        cells.clear();
        water.clear();
        water_cells.clear();
        let any_water = ticks.iter().any(|tick| tick.water.is_some());
        let mut most_tiles = 0;
        for (tick, index) in ticks.iter_mut().zip(0..) {
            tick.first = [tiles.len() as u32, cells.len() as u32, water_cells.len() as u32];
            most_tiles = tick.tiles.len().max(most_tiles);
            let first_source = sources.len() as u32;
            let moved = |tile: &GridTile| GridTile { first_source: tile.first_source + first_source, ..*tile };
            tiles.extend(tick.tiles.iter().map(moved));
            params.push(tick.params);
            sources.extend_from_slice(&tick.sources);
            cells.extend_from_slice(&tick.cells);
            water_cells.extend_from_slice(&tick.water_cells);
            if any_water {
                water.push(tick.water.as_deref().copied().unwrap_or_else(TickWater::zeroed));
            }
            let of_tick = index * COUNT_WORDS;
            for Work { first, substep, count, groups, .. } in tick.dispatches() {
                let work = match groups {
                    pack::Groups::Listed(list) => of_tick + 4 * list,
                    pack::Groups::Counted(_) => of_tick,
                };
                let mut slot = Slot::zeroed();
                slot[0] = GridDispatch { first, substep, count, work };
                uniforms.push(slot);
            }
            let mut own = [0u32; COUNT_WORDS as usize];
            own[..ACTIVE_WORD as usize].as_chunks_mut::<4>().0.fill([0, 1, 1, 0]);
            counts.extend(own);
        }
        let lists = [
            size_of_val(uniforms.as_slice()),
            size_of_val(params.as_slice()),
            size_of_val(tiles.as_slice()),
            size_of_val(sources.as_slice()),
            size_of_val(cells.as_slice()),
            size_of_val(water.as_slice()),
            size_of_val(water_cells.as_slice()),
            size_of_val(counts.as_slice()),
        ];
        // All of it or nothing: half a tick would be another one.
        if !frame.reserve(lists.iter().sum::<usize>() as u64, lists.len() as u64) {
            return false;
        }
        let mut stale = self.dispatches.write(frame, uniforms);
        stale |= self.params.write(frame, params);
        stale |= self.tiles.write(frame, tiles);
        stale |= self.sources.write(frame, sources);
        stale |= self.cells.write(frame, cells);
        if any_water {
            stale |= self.water.write(frame, water);
            stale |= self.water_cells.write(frame, water_cells);
            stale |= self.groups.as_ref().is_some_and(|groups| groups.water.is_none());
        }
        stale |= self.counts.write(frame, counts);
        let list = most_tiles as u64 * u64::from(LIST_COUNT) * 16;
        if list > self.list.size() {
            self.list = create(frame.device(), "grid list", wgpu::BufferUsages::STORAGE, list);
            stale = true;
        }
        if stale {
            self.groups = None;
        }
        true
    }

    /// The bind groups that [`Self::bind`] made.
    pub(super) fn groups(&self) -> Option<&Groups> {
        self.groups.as_ref()
    }

    /// The bind group that [`Self::upload_draws`] made.
    pub(super) fn draw_group(&self) -> Option<&wgpu::BindGroup> {
        self.draw_group.as_ref().map(|(_, group)| group)
    }

    /// Makes the bind groups for what was uploaded, those of dispersive grids if there are `any_water`.
    pub(super) fn bind(&mut self, device: &wgpu::Device, passes: &Passes, any_water: bool) -> &Groups {
        self.groups.get_or_insert_with(|| {
            let state = [
                first(&self.dispatches, size_of::<GridDispatch>()),
                first(&self.params, size_of::<TickParams>()),
                self.heights.as_entire_binding(),
                self.memory.as_entire_binding(),
                self.ground.as_entire_binding(),
            ];
            let schedule = [&self.tiles.buffer, &self.list, &self.counts.buffer, &self.marks];
            let lists = [&self.sources.buffer, &self.cells.buffer, &self.list, &self.counts.buffer, &self.marks];
            let [schedule, lists] = [&schedule[..], &lists[..]]
                .map(|buffers| buffers.iter().map(|buffer| buffer.as_entire_binding()).collect::<Vec<_>>());
            let water = passes.water().filter(|_| any_water).map(|passes| {
                let params = first(&self.water, size_of::<TickWater>());
                let of = |layout, others: &[&wgpu::Buffer]| {
                    let mut resources = vec![params.clone()];
                    let shared = [&self.fields, &self.faces];
                    resources.extend(shared.iter().chain(others).map(|buffer| buffer.as_entire_binding()));
                    bind_group(device, "grid water", layout, &resources)
                };
                WaterGroups {
                    medium: of(&passes.medium_layout, &[&self.water_cells.buffer]),
                    prepare: of(&passes.prepare_layout, &[&self.list, &self.sources.buffer]),
                    step: of(&passes.step_layout, &[&self.list, &self.counts.buffer, &self.marks]),
                }
            });
            Groups {
                water,
                state: bind_group(device, "grid state", &passes.layouts.state, &state),
                schedule: bind_group(device, "grid schedule", &passes.layouts.schedule, &schedule),
                lists: bind_group(device, "grid lists", &passes.layouts.lists, &lists),
                counts: self.counts.buffer.clone(),
            }
        })
    }

    /// Heights and medium of all grids.
    pub(super) fn heights_and_ground(&self) -> [&wgpu::Buffer; 2] {
        [&self.heights, &self.ground]
    }

    /// Uploads what is to be drawn into `pool`.
    pub(super) fn upload_draws(
        &mut self,
        frame: &mut Frame<'_>,
        passes: &Passes,
        pool: &wgpu::Buffer,
        draws: &[GridDraw],
    ) {
        let grown = self.draws.write(frame, draws);
        if grown || self.draw_group.as_ref().is_some_and(|(bound, _)| bound != pool) {
            self.draw_group = None;
        }
        self.draw_group.get_or_insert_with(|| {
            let buffers = [&self.draws.buffer, &self.heights, pool, &self.ground];
            let resources = buffers.map(wgpu::Buffer::as_entire_binding);
            (pool.clone(), bind_group(frame.device(), "grid draw", &passes.layouts.draw, &resources))
        });
    }
}
