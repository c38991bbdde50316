//! The flags of render settings, from the table of settings.

use super::DevelopFlags;
use crate::args::values;
use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use glimray_app::settings::{PictureOverrides, SETTINGS, Setting};
use glimray_app::value_forms::Control;

/// The flags of the settings of the table from `FIRST` on, before `END`.
#[derive(Debug, Default)]
pub struct SettingFlags<const FIRST: usize, const END: usize> {
    pub given: PictureOverrides,
}

/// Resolution and sample count.
pub type SizeFlags = SettingFlags<0, 2>;

/// All but the size, which is first, and the region, which is last.
pub type ViewSettingFlags = SettingFlags<1, { SETTINGS.len() - 1 }>;

/// How the picture is rendered and developed.
#[derive(Debug, Default, Args)]
pub struct PictureFlags {
    #[command(flatten)]
    pub settings: SettingFlags<0, { SETTINGS.len() }>,
    #[command(flatten)]
    pub develop: DevelopFlags,
}

impl PictureFlags {
    pub fn overrides(&self) -> PictureOverrides {
        PictureOverrides {
            denoise: self.develop.denoise(),
            ..self.settings.given.clone()
        }
    }
}

impl<const FIRST: usize, const END: usize> Args for SettingFlags<FIRST, END> {
    fn augment_args(command: Command) -> Command {
        let settings = SETTINGS[FIRST..END].iter();
        command
            .next_help_heading("Picture")
            .args(settings.map(flag))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const FIRST: usize, const END: usize> FromArgMatches for SettingFlags<FIRST, END> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = PictureOverrides::default();
        for setting in &SETTINGS[FIRST..END] {
            let text = match (setting.control)() {
                Control::Switch(_) => matches.get_flag(setting.name).then_some(""),
                _ => (matches.get_one::<String>(setting.name)).map(String::as_str),
            };
            if let Some(text) = text {
                (setting.give)(&mut given, text)
                    .map_err(|why| Error::raw(ErrorKind::ValueValidation, why))?;
            }
        }
        Ok(Self { given })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The flag of a setting.
fn flag(setting: &'static Setting) -> Arg {
    let flag = Arg::new(setting.name)
        .long(setting.flag.trim_start_matches('-'))
        .help(setting.help);
    let flag = match setting.details {
        "" => flag,
        details => flag.long_help(format!("{}\n\n{details}", setting.help)),
    };
    match (setting.control)() {
        Control::Switch(_) => flag.action(ArgAction::SetTrue),
        Control::Names(names) => {
            (flag.value_name(setting.value)).value_parser(values::possible(names.into_iter()))
        }
        _ => (flag.value_name(setting.value))
            .allow_hyphen_values(true)
            .value_parser(|text: &str| {
                (setting.give)(&mut PictureOverrides::default(), text).map(|()| text.to_owned())
            }),
    }
}
