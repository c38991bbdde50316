//! `lib/media.wesl`: the list of media that a ray is inside of.

use crate::support::{harness::gpu, random::Random, verdict::Verdict};

const NONE: u32 = u32::MAX;

const STEP: &str = "
    import package::lib::media::{contains, entered, has_room, left};
    fn probe(media: vec4u, material: u32, enters: u32) -> vec4u {
        return select(left(media, material), entered(media, material), vec4<bool>(enters == 1u));
    }
";

const ASK: &str = "
    import package::lib::media::{contains, has_room};
    fn probe(media: vec4u, material: u32) -> vec2u {
        return vec2u(u32(contains(media, material)), u32(has_room(media)));
    }
";

fn packed(list: &[u32]) -> [u32; 4] {
    std::array::from_fn(|i| list.get(i).copied().unwrap_or(NONE))
}

/// Lists of up to four of three materials.
fn lists() -> Vec<Vec<u32>> {
    let mut random = Random::new(3);
    let mut list = || {
        (0..random.below(5))
            .map(|_| random.below(3) as u32)
            .collect()
    };
    (0..2000).map(|_| list()).collect()
}

#[test]
fn media_are_entered_and_left_in_order() {
    let mut rows = Vec::new();
    let mut expected = Vec::new();
    for list in lists() {
        for material in 0..3 {
            let mut entered = list.clone();
            if entered.len() < 4 {
                entered.push(material);
            }
            let mut left = list.clone();
            if let Some(last) = left.iter().rposition(|&m| m == material) {
                left.remove(last);
            }
            rows.push((packed(&list), material, 1u32));
            expected.push(packed(&entered));
            rows.push((packed(&list), material, 0u32));
            expected.push(packed(&left));
        }
    }
    let got: Vec<[u32; 4]> = gpu().map_source(STEP, &rows);
    let mut verdict = Verdict::on("media");
    for ((row, expected), got) in rows.iter().zip(&expected).zip(&got) {
        verdict.that(format!("{row:?}"), got == expected, || {
            format!("{got:?} for {expected:?}")
        });
    }
    verdict.close();
}

#[test]
fn a_list_knows_what_is_in_it_and_whether_it_is_full() {
    let rows: Vec<_> = lists()
        .iter()
        .flat_map(|list| (0..3).map(|material| (packed(list), material)))
        .collect();
    let got: Vec<[u32; 2]> = gpu().map_source(ASK, &rows);
    let mut verdict = Verdict::on("media");
    for (row, got) in rows.iter().zip(&got) {
        let expected = [
            u32::from(row.0.contains(&row.1)),
            u32::from(row.0[3] == NONE),
        ];
        verdict.that(format!("{row:?}"), *got == expected, || format!("{got:?}"));
    }
    verdict.close();
}
