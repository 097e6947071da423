//! Capitals, digits and marks of three by five dots.

use image::{Rgba, RgbaImage};

/// Rows from the top, three dots each, left dot first.
const GLYPHS: &[(char, [&str; 5])] = &[
    ('A', [".#.", "#.#", "###", "#.#", "#.#"]),
    ('B', ["##.", "#.#", "##.", "#.#", "##."]),
    ('C', [".##", "#..", "#..", "#..", ".##"]),
    ('D', ["##.", "#.#", "#.#", "#.#", "##."]),
    ('E', ["###", "#..", "##.", "#..", "###"]),
    ('F', ["###", "#..", "##.", "#..", "#.."]),
    ('G', [".##", "#..", "#.#", "#.#", ".##"]),
    ('H', ["#.#", "#.#", "###", "#.#", "#.#"]),
    ('I', ["###", ".#.", ".#.", ".#.", "###"]),
    ('J', ["..#", "..#", "..#", "#.#", ".#."]),
    ('K', ["#.#", "#.#", "##.", "#.#", "#.#"]),
    ('L', ["#..", "#..", "#..", "#..", "###"]),
    ('M', ["#.#", "###", "###", "#.#", "#.#"]),
    ('N', ["##.", "#.#", "#.#", "#.#", "#.#"]),
    ('O', [".#.", "#.#", "#.#", "#.#", ".#."]),
    ('P', ["##.", "#.#", "##.", "#..", "#.."]),
    ('Q', [".#.", "#.#", "#.#", "##.", ".##"]),
    ('R', ["##.", "#.#", "##.", "#.#", "#.#"]),
    ('S', [".##", "#..", ".#.", "..#", "##."]),
    ('T', ["###", ".#.", ".#.", ".#.", ".#."]),
    ('U', ["#.#", "#.#", "#.#", "#.#", "###"]),
    ('V', ["#.#", "#.#", "#.#", "#.#", ".#."]),
    ('W', ["#.#", "#.#", "###", "###", "#.#"]),
    ('X', ["#.#", "#.#", ".#.", "#.#", "#.#"]),
    ('Y', ["#.#", "#.#", ".#.", ".#.", ".#."]),
    ('Z', ["###", "..#", ".#.", "#..", "###"]),
    ('0', ["###", "#.#", "#.#", "#.#", "###"]),
    ('1', [".#.", "##.", ".#.", ".#.", "###"]),
    ('2', ["##.", "..#", ".#.", "#..", "###"]),
    ('3', ["##.", "..#", ".#.", "..#", "##."]),
    ('4', ["#.#", "#.#", "###", "..#", "..#"]),
    ('5', ["###", "#..", "##.", "..#", "##."]),
    ('6', [".##", "#..", "###", "#.#", "###"]),
    ('7', ["###", "..#", ".#.", ".#.", ".#."]),
    ('8', ["###", "#.#", "###", "#.#", "###"]),
    ('9', ["###", "#.#", "###", "..#", "##."]),
    ('.', ["...", "...", "...", "...", ".#."]),
    (',', ["...", "...", "...", ".#.", "#.."]),
    (':', ["...", ".#.", "...", ".#.", "..."]),
    ('+', ["...", ".#.", "###", ".#.", "..."]),
    ('-', ["...", "...", "###", "...", "..."]),
    ('/', ["..#", "..#", ".#.", "#..", "#.."]),
    ('%', ["#.#", "..#", ".#.", "#..", "#.#"]),
    ('(', [".#.", "#..", "#..", "#..", ".#."]),
    (')', [".#.", "..#", "..#", "..#", ".#."]),
    ('=', ["...", "###", "...", "###", "..."]),
];

/// Dots per character, the gap included.
pub(crate) const ADVANCE: usize = 4;
/// Dots per line, the gap included.
pub(crate) const LINE: usize = 7;
/// Pixels of a picture along a side of a dot, and around the text.
const DOT: u32 = 2;
const MARGIN: u32 = 8;

/// Calls `dot` with the column and row of every dot of a text, small letters as capitals; what has no glyph is a blank.
pub(crate) fn dots(text: &str, mut dot: impl FnMut(usize, usize)) {
    for (line, chars) in text.lines().enumerate() {
        for (place, c) in chars.chars().enumerate() {
            let upper = c.to_ascii_uppercase();
            let Some((_, rows)) = GLYPHS.iter().find(|(glyph, _)| *glyph == upper) else {
                continue;
            };
            for (y, row) in rows.iter().enumerate() {
                for x in row.bytes().enumerate().filter(|(_, b)| *b == b'#').map(|(x, _)| x) {
                    dot(place * ADVANCE + x, line * LINE + y);
                }
            }
        }
    }
}

/// Writes `text` into the upper left corner of a picture, on a darkened panel so that it reads on any water.
pub(crate) fn label(picture: &mut RgbaImage, text: &str) {
    let columns = text.lines().map(|line| line.chars().count()).max().unwrap_or(0) * ADVANCE;
    let rows = text.lines().count() * LINE;
    let panel = [columns, rows].map(|dots| (DOT as usize * dots) as u32 + 2 * MARGIN);
    for y in 0..panel[1].min(picture.height()) {
        for x in 0..panel[0].min(picture.width()) {
            let [red, green, blue, alpha] = picture.get_pixel(x, y).0;
            picture.put_pixel(x, y, Rgba([red / 2, green / 2, blue / 2, alpha]));
        }
    }
    dots(text, |x, y| {
        let [x, y] = [x, y].map(|dot| MARGIN + DOT * dot as u32);
        for (x, y) in (0..DOT * DOT).map(|k| (x + k % DOT, y + k / DOT)) {
            if let Some(pixel) = picture.get_pixel_mut_checked(x, y) {
                *pixel = Rgba([225, 225, 225, 255]);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_has_three_columns_and_differs() {
        for (i, (c, rows)) in GLYPHS.iter().enumerate() {
            assert!(rows.iter().all(|row| row.len() == 3), "{c}");
            assert!(GLYPHS[..i].iter().all(|(_, other)| other != rows), "{c}");
        }
    }

    #[test]
    fn lines_and_places() {
        let mut found = Vec::new();
        dots("a\n .", |x, y| found.push((x, y)));
        assert_eq!(found.len(), 10 + 1);
        assert_eq!(found.last(), Some(&(5, LINE + 4)));
    }
}
