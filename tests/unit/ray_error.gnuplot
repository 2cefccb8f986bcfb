set terminal pngcairo size 900,420 font "sans,11"
set output out
set logscale y
set format y "10^{%L}"
set yrange [1e-17:10]
set xrange [2:-323]
set xlabel "log_{10} κ (lens radii per focus distance): 0 is one radius away, −323 is as good as infinity"
set ylabel "error of the unit direction"
set key left at graph 0.02, 0.92 Left reverse
set grid ytics lc rgb "#dddddd"
plot data using 1:3 with lines lw 2 lc rgb "#d62728" title "R = P_f − S, S − P_f (the two cases)", \
     data using 1:2 with lines lw 2 lc rgb "#1f77b4" title "R = v − κS", \
     1.5e-8 with lines dt 2 lc rgb "#999999" title "half the digits"
