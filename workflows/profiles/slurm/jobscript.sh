#!/bin/sh
# properties = {properties}
# Where Slurm forgets a job soon after its end and keeps no accounts, this file tells how it ended.
[ -z "$MEDIAL_VK_ENDS" ] || rm -f "$MEDIAL_VK_ENDS/$SLURM_JOB_ID"
(
{exec_job}
)
code=$?
[ -z "$MEDIAL_VK_ENDS" ] || echo "$code" > "$MEDIAL_VK_ENDS/$SLURM_JOB_ID"
exit "$code"
