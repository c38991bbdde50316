//! Film files: exact round trip; files that are not films, truncated, damaged or of another version are
//! rejected.

use crate::film::{bytes, film, stratified};
use crate::reference::scenes;
use crate::support::random::Random;
use glimray::render::{Film, FilmError, RenderSettings};
use std::io::{self, Read};

/// Films of one block and of several, with a hole.
fn small() -> Film {
    let scene = scenes::spheres();
    let part = |crop, sample_range| {
        let settings = RenderSettings {
            crop: Some(crop),
            sample_range: Some(sample_range),
            ..stratified(150, (7, 5))
        };
        film(&scene, &settings)
    };
    let first = part([0, 0, 3, 2], 0..150);
    first
        .merge(&part([4, 1, 7, 5], 64..128))
        .expect("one picture")
}

#[test]
fn a_film_is_read_as_it_was_written() {
    let film = small();
    let written = bytes(&film);
    let read = Film::read(&written[..]).expect("a film");
    assert_eq!(read, film);
    assert!(bytes(&read) == written);
    let region = read.parts().map(|(region, _)| region).collect::<Vec<_>>();
    assert_eq!(
        region,
        [[0, 0, 3, 1], [0, 1, 3, 1], [4, 1, 3, 1], [4, 2, 3, 3]]
    );
}

#[test]
fn every_film_that_is_cut_short_is_refused() {
    let written = bytes(&small());
    for length in 0..written.len() {
        let error = Film::read(&written[..length]).expect_err("too short");
        match (length, &error) {
            (..8, FilmError::NotAFilm) | (8.., FilmError::CutShort { .. }) => {}
            _ => panic!("{length}: {error}"),
        }
    }
    let longer = [&written[..], b"more"].concat();
    assert!(matches!(
        Film::read(&longer[..]),
        Err(FilmError::Damaged { .. })
    ));
}

#[test]
fn every_changed_bit_is_noticed() {
    let written = bytes(&small());
    let mut random = Random::new(5);
    let header = 0..400.min(written.len());
    let anywhere = (0..4000).map(|_| random.below(written.len()));
    for place in header.chain(anywhere) {
        let mut changed = written.clone();
        changed[place] ^= 1 << (place % 8);
        assert!(Film::read(&changed[..]).is_err(), "byte {place}");
    }
}

#[test]
fn random_bytes_are_not_a_film_and_another_version_is_named() {
    let noise: Vec<u8> = (0..200_u8).collect();
    assert!(matches!(Film::read(&noise[..]), Err(FilmError::NotAFilm)));
    let mut other = bytes(&small());
    other[8] = 77;
    let error = Film::read(&other[..]).expect_err("a version");
    assert!(error.to_string().contains("version 77"), "{error}");
}

/// Counts in a file beyond the available data cost no memory: reading fails first.
#[test]
fn counts_in_a_file_allocate_nothing_before_the_data_is_read() {
    let written = bytes(&small());
    for place in (8..written.len().min(400) - 4).step_by(2) {
        let mut changed = written.clone();
        changed[place..place + 4].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(Film::read(&changed[..]).is_err(), "byte {place}");
    }
}

#[test]
fn a_failing_reader_is_an_error_and_a_slow_one_is_not() {
    struct Trickle<'a>(&'a [u8], usize);
    impl Read for Trickle<'_> {
        fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
            self.1 += 1;
            if self.1.is_multiple_of(3) {
                return Err(io::ErrorKind::Interrupted.into());
            }
            let count = into.len().min(7);
            self.0.read(&mut into[..count])
        }
    }
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("broken"))
        }
    }
    let film = small();
    assert_eq!(Film::read(Trickle(&bytes(&film), 0)).expect("a film"), film);
    assert!(matches!(Film::read(Broken), Err(FilmError::Io(_))));
}
