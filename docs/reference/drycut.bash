# Completion of drycut for bash.
_drycut() {
  local word="${COMP_WORDS[COMP_CWORD]}" words=""
  case "$COMP_CWORD:${COMP_WORDS[1]}" in
    1:*) COMPREPLY=($(compgen -W "run check cam tune bode compare devices plants --help --version" -- "$word")); return ;;
    2:devices) COMPREPLY=($(compgen -W "CAMMING4 EANPOS EPICPOS OOPOS2 QMOVE PLCOPEN AXIS MC_Power MC_Home MC_Reset MC_Stop MC_Halt MC_MoveAbsolute MC_MoveRelative MC_MoveAdditive MC_MoveSuperImposed MC_MoveVelocity MC_CamTableSelect MC_CamIn MC_CamOut MC_GearIn MC_GearOut MC_Phasing MC_SetPosition MC_SetOverride MC_ReadActualPosition MC_ReadActualVelocity MC_ReadStatus MC_ReadAxisError MC_ReadAxisInfo MC_ReadMotionState MC_ReadParameter MC_WriteParameter MC_TouchProbe MC_AbortTrigger CAM_TABLE_WRITE DECAM ECAMTBX LX3VP --json --help" -- "$word")); return ;;
    2:plants) COMPREPLY=($(compgen -W "backlash_axis bench flying_saw ideal_axis linear_axis rotary_knife vertical_press web --json --help" -- "$word")); return ;;
  esac
  case "${COMP_WORDS[1]}" in
    run) words="--help --out --jobs --seed --no-pictures --gltf --verify-step --set" ;;
    check) words="--help --expand --set --schema" ;;
    cam) words="--help --device --master-speed --max-velocity --max-acceleration --at --csv --png --table --loops --strict" ;;
    tune) words="--help --vary --minimise --constraint --wire --at --amplitude --from --ignore-checks --budget --jobs --seed --spread --spread-runs --set --out --no-pictures" ;;
    bode) words="--help --wire --speed --at --from --to --points --amplitude --settle --limit-cycle --min-phase-margin --min-gain-margin --csv --png --out --set" ;;
    compare) words="--help --out --from --fail-on-difference --no-pictures" ;;
    devices) words="--help --json" ;;
    plants) words="--help --json" ;;
  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}
complete -o filenames -F _drycut drycut
