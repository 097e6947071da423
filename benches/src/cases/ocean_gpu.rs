//! Case `fft_gpu`: the fields that the GPU synthesises against a direct sum.

use ocean_spectrum::{Ocean, Outputs, gpu::GpuOcean};

use super::ocean_fft::{NAMES, compare, exact_time};
use crate::{
    evidence::{Axis, Case, CaseError, Context, Plot, Row, measure_together},
    fixtures,
};

/// See the module.
pub(super) const GPU: Case = Case {
    name: "fft_gpu",
    about: "fields of the GPU synthesis against a direct sum in f64; the CPU's beside it",
    plots: &[Plot {
        file: "fft_gpu",
        title: "Synthesis of three cascades on the GPU",
        x: Axis::Param("size"),
        y: Axis::Time,
        label: None,
    }],
    run,
};

/// Fields that the GPU makes: displacement and derivative.
const FIELDS: usize = 8;

fn run(context: &Context) -> Result<Vec<Row>, CaseError> {
    let gpu = context.gpu()?;
    let mut rows = Vec::new();
    for &size in context.pick(&[128, 256][..], &[64, 128, 256, 512, 1024]) {
        let mut ocean = Ocean::new(fixtures::ocean(size))?;
        let mut gpu_ocean = GpuOcean::new(&gpu.device, &ocean)?;
        let time = exact_time(&ocean);
        gpu.frame(|frame| gpu_ocean.encode_fields(frame, &ocean, time))?;
        let texels = gpu.read_texture(gpu_ocean.fields())?;
        let (layer, cascades) = ((size * size) as usize, ocean.modes().len());
        let mut worst = (0.0f64, "");
        for c in 0..cascades {
            let errors = compare(&ocean, c, |texel| {
                let made = [texels[c * layer + texel], texels[(cascades + c) * layer + texel]];
                std::array::from_fn(|i| if i < FIELDS { f64::from(made[i / 4][i % 4]) } else { 0.0 })
            });
            for (error, name) in errors.into_iter().zip(NAMES).take(FIELDS) {
                if error > worst.0 || error.is_nan() {
                    worst = (error, name);
                }
            }
        }
        let still = Ocean::new(fixtures::ocean(size))?;
        let (mut drawn, mut time) = (0.0, 0.0);
        let mut failed = None;
        let [ours, cpu] = measure_together(
            context.effort,
            [
                &mut || {
                    drawn += 1.0 / 60.0;
                    failed = gpu.frame(|frame| gpu_ocean.encode_fields(frame, &still, drawn)).err().or(failed.take());
                },
                &mut || {
                    time += 1.0 / 60.0;
                    ocean.set_time(time);
                    ocean.prepare(Outputs::ALL);
                },
            ],
        );
        if let Some(error) = failed {
            return Err(error);
        }
        rows.push(
            Row::new("fft_gpu", gpu.adapter.kind.clone())
                .param("size", size)
                .param("cascades", cascades)
                .param("worst_field", worst.1)
                .error(worst.0, "relative RMS", "direct sum in f64")
                .bound(3e-6)
                .time("eight fields of every cascade: encode, submit, wait", &ours)
                .baseline("the CPU synthesis of twelve fields, all threads", &cpu),
        );
    }
    Ok(rows)
}
