//! The composite surface's bind group: table, cascades, pool of drawn heights, rasters of the land.

use ocean_spectrum::Ocean;
use ocean_spectrum::gpu::GpuOcean;
use open_water_shaders::pipeline::{Frame, bind_group};
use open_water_shaders::surface::{self, HIDDEN_SLOPE_BIAS, SurfaceCascade, SurfaceGrid, SurfaceLand, SurfaceTable};

use super::dry::DryRoom;
use super::land::{Land, LandTexels};
use crate::OpenWaterError;
use crate::grids::{Grid, REACH};
use crate::land::ShoreMark;

/// Looks repeat their time after this long, so that it stays exact in an f32, seconds.
const LOOKS_TIME: f64 = 3600.0;

pub(crate) struct SurfaceBinding {
    layout: wgpu::BindGroupLayout,
    table: wgpu::Buffer,
    pool: wgpu::Buffer,
    pub(super) dry: DryRoom,
    sampler: wgpu::Sampler,
    /// Stands in for the cascades of a calm sea, and for the land of the open sea.
    blank: wgpu::TextureView,
    land: Option<Land>,
    /// Room for the land to come.
    room: Option<Land>,
    group: wgpu::BindGroup,
}

impl SurfaceBinding {
    pub(crate) fn new(device: &wgpu::Device, ocean: Option<&GpuOcean>) -> Self {
        let layout = surface::layout(device);
        let table = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("surface_table"),
            size: size_of::<SurfaceTable>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("looks_sampler"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let blank = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("calm_sea"),
                size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba16Float,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
            .create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            });
        let pool = pool(device, 1);
        let views = Views { ocean, land: None, blank: &blank };
        let group = group(device, &layout, &table, &pool, &sampler, views);
        Self { layout, table, pool, sampler, blank, land: None, room: None, dry: DryRoom::default(), group }
    }

    /// A pool of another size, and the group that has it.
    pub(crate) fn make_pool(
        &self,
        device: &wgpu::Device,
        ocean: Option<&GpuOcean>,
        cells: u32,
    ) -> (wgpu::Buffer, wgpu::BindGroup) {
        let pool = pool(device, cells.max(1));
        let views = Views { ocean, land: self.land.as_ref(), blank: &self.blank };
        let group = group(device, &self.layout, &self.table, &pool, &self.sampler, views);
        (pool, group)
    }

    pub(crate) fn set_pool(&mut self, (pool, group): (wgpu::Buffer, wgpu::BindGroup)) {
        (self.pool, self.group) = (pool, group);
        self.dry.lose();
    }

    /// Makes room for land of that size.
    ///
    /// # Errors
    /// The rasters are larger than the device's textures may be.
    pub(crate) fn room_for_land(&mut self, device: &wgpu::Device, size: [u32; 2]) -> Result<(), OpenWaterError> {
        if self.land.as_ref().is_none_or(|land| land.size() != size) {
            self.room = Some(Land::new(device, size)?);
        }
        Ok(())
    }

    pub(crate) fn let_room_go(&mut self) {
        self.room = None;
    }

    /// Replaces the land. The group changes when land comes, goes or has another size. The table tells of it when it is
    /// written next.
    ///
    /// # Errors
    /// The rasters are larger than the device's textures may be.
    pub(crate) fn set_land(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        ocean: Option<&GpuOcean>,
        texels: Option<&LandTexels>,
    ) -> Result<(), OpenWaterError> {
        match (texels, &mut self.land) {
            (None, None) => return Ok(()),
            (None, land) => *land = None,
            (Some(texels), Some(land)) if land.size() == texels.size => {
                land.write(queue, texels);
                return Ok(());
            }
            (Some(texels), land) => {
                let room = self.room.take().filter(|room| room.size() == texels.size);
                let mut new = room.map_or_else(|| Land::new(device, texels.size), Ok)?;
                new.write(queue, texels);
                *land = Some(new);
            }
        }
        self.bind(device, ocean);
        Ok(())
    }

    pub(crate) fn bind(&mut self, device: &wgpu::Device, ocean: Option<&GpuOcean>) {
        let views = Views { ocean, land: self.land.as_ref(), blank: &self.blank };
        self.group = group(device, &self.layout, &self.table, &self.pool, &self.sampler, views);
    }

    pub(crate) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    pub(crate) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    pub(crate) fn pool(&self) -> &wgpu::Buffer {
        &self.pool
    }

    /// `size` is that of the cascades' layers, texels per side; the sea comes with how many cascades are to be read.
    pub(crate) fn write_table<'a>(
        &mut self,
        frame: &mut Frame<'_>,
        time: f64,
        sea: Option<(&Ocean, usize)>,
        grids: impl Iterator<Item = &'a Grid>,
        shore: ShoreMark,
        size: u32,
    ) {
        let mut table = SurfaceTable { time: (time % LOOKS_TIME) as f32, ..Default::default() };
        if let Some((ocean, cascades)) = sea {
            table.significant_height = ocean.significant_height();
            for (i, slope) in table.hidden_slope.iter_mut().enumerate() {
                *slope = ocean.hidden_slope((i as f32 - HIDDEN_SLOPE_BIAS as f32).exp2());
            }
            let modes = ocean.mode_sets_at(time).0.iter().take(cascades);
            for ((entry, modes), offset) in table.cascades.iter_mut().zip(modes).zip(ocean.offsets_at(time)) {
                *entry = SurfaceCascade { offset: offset.into(), tile: modes.tile, size: size as f32 };
                table.cascade_count += 1;
            }
        }
        for (entry, grid) in table.grids.iter_mut().zip(grids) {
            let window = grid.window();
            *entry = SurfaceGrid {
                corner: window.local_corner(grid.origin).into(),
                cell_size: window.cell_size,
                base: grid.base,
                cells: window.cells,
                gain: grid.gain,
                middle: grid.middle.into(),
                reach: REACH,
                tiled: u32::from(grid.repeats()),
            };
            table.grid_count += 1;
        }
        let land = self.land.as_ref().map(|land| land.entry(shore.origin));
        table.land = SurfaceLand { level: shore.level, ..land.unwrap_or_default() };
        self.dry.write(frame, &self.pool);
        self.dry.tell(&mut table);
        frame.write(&self.table, 0, bytemuck::bytes_of(&table));
    }
}

fn pool(device: &wgpu::Device, cells: u32) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("surface_grids"),
        size: u64::from(cells) * size_of::<[f32; 2]>() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

/// What the group's textures show.
struct Views<'a> {
    ocean: Option<&'a GpuOcean>,
    land: Option<&'a Land>,
    blank: &'a wgpu::TextureView,
}

fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    table: &wgpu::Buffer,
    pool: &wgpu::Buffer,
    sampler: &wgpu::Sampler,
    views: Views<'_>,
) -> wgpu::BindGroup {
    let cascades = match views.ocean {
        Some(o) => [o.displacement(), o.derivative(), o.looks_displacement(), o.looks_derivative()],
        None => [views.blank; 4],
    };
    let [displacement, derivative, looks_displacement, looks_derivative] =
        cascades.map(wgpu::BindingResource::TextureView);
    bind_group(
        device,
        "surface",
        layout,
        &[
            table.as_entire_binding(),
            displacement,
            derivative,
            pool.as_entire_binding(),
            looks_displacement,
            looks_derivative,
            wgpu::BindingResource::Sampler(sampler),
            wgpu::BindingResource::TextureView(views.land.map_or(views.blank, Land::view)),
        ],
    )
}
