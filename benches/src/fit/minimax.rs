//! The smallest largest error, by least squares of rising powers (Levenberg and Marquardt's steps).

/// Errors at a point, written into a list.
type Errors<'a> = &'a dyn Fn(&[f64], &mut Vec<f64>);

/// Moves `p` to where the sum of |error / largest|^power is least, with powers 2, 4, .. up to `power`. `tether` adds
/// (tether (p - start))^2 for each parameter: it decides where the errors hardly do.
pub(super) fn minimise(errors: Errors, p: &mut [f64], power: f64, tether: f64) {
    let start = p.to_vec();
    let mut now = Vec::new();
    let mut exponent = 1.0;
    while 2.0 * exponent <= power {
        errors(p, &mut now);
        let scale = now.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
        least_squares(
            &|p, out| {
                errors(p, out);
                out.iter_mut().for_each(|x| *x = (x.abs() / scale).powf(exponent) * x.signum());
                out.extend(p.iter().zip(&start).map(|(p, start)| tether * (p - start)));
            },
            p,
        );
        exponent *= 2.0;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn least_squares(errors: Errors, p: &mut [f64]) {
    const STEP: f64 = 1e-6;
    let n = p.len();
    let (mut now, mut next) = (Vec::new(), Vec::new());
    errors(p, &mut now);
    let (mut cost, mut damping, mut still) = (dot(&now, &now), 1e-3, 0);
    for _ in 0..200 {
        let slopes: Vec<Vec<f64>> = (0..n)
            .map(|j| {
                let mut aside = |by: f64| {
                    let mut q = p.to_vec();
                    q[j] += by;
                    errors(&q, &mut next);
                    next.clone()
                };
                let (up, down) = (aside(STEP), aside(-STEP));
                up.iter().zip(down).map(|(up, down)| (up - down) / (2.0 * STEP)).collect()
            })
            .collect();
        let improved = (0..20).any(|_| {
            let system = (0..n).map(|i| {
                let mut row: Vec<f64> = slopes.iter().map(|slope| dot(&slopes[i], slope)).collect();
                row[i] = row[i] * (1.0 + damping) + 1e-12;
                row.push(-dot(&slopes[i], &now));
                row
            });
            let step = solve(system.collect());
            // Parameters are logarithms: none may change by more than 1.6 times at once.
            let longest = step.iter().fold(0.5f64, |most, x| most.max(x.abs()));
            let q: Vec<f64> = p.iter().zip(step).map(|(p, step)| p + 0.5 / longest * step).collect();
            errors(&q, &mut next);
            let lower = dot(&next, &next);
            if lower >= cost || lower.is_nan() {
                damping *= 4.0;
                return false;
            }
            still = if cost - lower < 1e-9 * cost { still + 1 } else { 0 };
            cost = lower;
            p.copy_from_slice(&q);
            std::mem::swap(&mut now, &mut next);
            damping = (damping * 0.3).max(1e-12);
            true
        });
        if !improved || still > 3 {
            return;
        }
    }
}

/// Gauss's elimination of rows with their right side last.
fn solve(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs())).unwrap_or(i);
        rows.swap(i, pivot);
        let (above, below) = rows.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / above[i][i];
            row.iter_mut().zip(&above[i]).for_each(|(x, pivot)| *x -= factor * pivot);
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * x[j]).sum();
        x[i] = (rows[i][n] - known) / rows[i][i];
    }
    x
}
